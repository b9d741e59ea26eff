// Head, figures and end of the page; and the tables that its parts are made of.
#include "core/minutes/page.h"

#include "core/base/moment.h"
#include "core/report/page.h"

namespace bl::minutes {

namespace {

// Line breaks in what people have written stay.
constexpr std::string_view kOwnStyle = "td{white-space:pre-line}code{overflow-wrap:anywhere}\n";

std::string title_of(const Account& account) { return account.title.empty() ? "Room " + account.code : account.title; }

// By this, the pages of one session are told from those of others.
std::string session_of(const Account& account) { return account.code + " " + std::to_string(account.created); }

drawing::Markup page_begun(const std::string& session) {
  drawing::Markup page;
  page.raw("<!DOCTYPE html>\n");
  page.open("html", {{"xmlns", "http://www.w3.org/1999/xhtml"}, {"lang", "en"}}).open("head");
  page.leaf("meta", {{"name", "minutes-of"}, {"content", session}});
  return page;
}

void key(drawing::Markup& page, const std::string& label, const std::string& figure, const std::string& note) {
  page.open("div").element("dt", label).open("dd").text(figure).element("small", note).close().close();
}

std::size_t still_open(const Account& account) {
  std::size_t count = 0;
  for (const auto& [id, comment] : account.state.comments) count += comment.state == room::CommentState::open ? 1 : 0;
  return count;
}

void write_header(drawing::Markup& page, const Account& account) {
  page.open("header").element("h1", title_of(account));
  page.element("p", "Minutes of the room " + account.code, {{"class", "about"}});
  page.open("dl", {{"class", "keys"}});
  const std::string dash = "\xE2\x80\x93";
  key(page, "Began", account.first ? account.time_of(*account.first) : dash, "the first entry");
  key(page, "Ended", account.last ? account.time_of(*account.last) : dash,
      account.state.is_closed ? "the room was closed" : "the room is not closed; this is the last entry");
  key(page, "People", std::to_string(account.state.seats.size()), "seats that were taken");
  key(page, "Entries", std::to_string(account.entries), "of the log");
  key(page, "Decisions", std::to_string(account.state.marks.size()), "and other marks for the minutes");
  key(page, "Proposals", std::to_string(account.proposals.size()), "drafts that were proposed");
  key(page, "Votes", std::to_string(account.rounds.size()), "that were opened");
  key(page, "Comments", std::to_string(account.comments.size()), std::to_string(still_open(account)) + " still open");
  page.close().close();
}

void write_footer(drawing::Markup& page, const Account& account) {
  page.open("footer").open("dl");
  const auto row = [&](const std::string& label, const std::string& text) { page.element("dt", label).element("dd", text); };
  row("Entries", std::to_string(account.entries));
  row("Hash of the log",
      (account.chain.empty() ? "none" : account.chain) +
          ": whoever has another log of this session, or one in which anything was changed, gets another hash");
  row("Times", account.zone == 0 ? "They are in UTC, which no summer time changes."
                                 : "They are by clocks that show UTC" + zone_text(account.zone) + ".");
  row("Names", "People appear by their pseudonyms. Words that were erased appear as [erased].");
  row("Made by",
      "BehaviourLinks, behaviourlinks minutes; these minutes have other files as well: decisions.csv, comments.csv and votes.csv "
      "for spreadsheets, log.jsonl, which behaviourlinks replay runs again, and the scenes of the scenarios and of the end");
  page.close().close();
}

}  // namespace

std::string page_beginning() {
  const std::string whole = page_begun("*").str();
  return whole.substr(0, whole.find('*'));
}

std::string page_beginning(const Account& account) { return page_begun(session_of(account)).str(); }

void write_table(drawing::Markup& page, const std::vector<std::string>& columns,
                 const std::vector<std::vector<std::string>>& rows, const std::string& otherwise) {
  if (rows.empty()) {
    page.element("p", otherwise);
    return;
  }
  const auto is_number = [&](std::size_t column) { return columns[column].starts_with('#'); };
  page.open("div", {{"class", "wide"}}).open("table").open("thead").open("tr");
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (is_number(k)) page.element("th", columns[k].substr(1), {{"class", "n"}});
    else page.element("th", columns[k]);
  }
  page.close().close().open("tbody");
  for (const auto& row : rows) {
    page.open("tr");
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (is_number(k)) page.element("td", row[k], {{"class", "n"}});
      else page.element("td", row[k]);
    }
    page.close();
  }
  page.close().close().close();
}

std::string write_page(const Account& account) {
  drawing::Markup page = page_begun(session_of(account));
  page.leaf("meta", {{"charset", "utf-8"}})
      .leaf("meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}});
  page.element("title", title_of(account) + ": minutes");
  page.open("style").raw(report::page_style()).raw(kOwnStyle).close().close();
  page.open("body");
  write_header(page, account);
  page.open("main");
  write_decisions(page, account);
  write_votes(page, account);
  write_proposals(page, account);
  write_comments(page, account);
  write_people(page, account);
  write_phases(page, account);
  write_scenarios(page, account);
  write_refusals(page, account);
  page.close();
  write_footer(page, account);
  page.close().close();
  return page.str();
}

}  // namespace bl::minutes
