// The page of the minutes: one self-contained XHTML document, for screens and paper.
#pragma once

#include <string>

#include "core/drawing/markup.h"
#include "core/minutes/account.h"

namespace bl::minutes {

std::string write_page(const Account& account);
/// What every page of this session begins with, and what a page of any session begins with.
std::string page_beginning(const Account& account);
std::string page_beginning();

/// Its parts, in the order of the page.
void write_decisions(drawing::Markup& page, const Account& account);
void write_votes(drawing::Markup& page, const Account& account);
void write_proposals(drawing::Markup& page, const Account& account);
void write_comments(drawing::Markup& page, const Account& account);
void write_people(drawing::Markup& page, const Account& account);
void write_phases(drawing::Markup& page, const Account& account);
void write_scenarios(drawing::Markup& page, const Account& account);
void write_refusals(drawing::Markup& page, const Account& account);

/// A table in which a column with a `#` before its name holds numbers. Without rows the sentence `otherwise` stands there.
void write_table(drawing::Markup& page, const std::vector<std::string>& columns,
                 const std::vector<std::vector<std::string>>& rows, const std::string& otherwise);

}  // namespace bl::minutes
