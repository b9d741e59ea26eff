// Steps of drafts in parts, which a page puts into words of its own language.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "core/graph/touch.h"
#include "core/room/drafts.h"
#include "core/wire/views.h"

namespace bl::wire {

/// A step as `{"id", "of", "what", "from", "to", "unit", "n"}`, of which all but the id may be missing. `id`: the command, with
/// `not_` before it where it ends something (`not_mute_link`); of a batch that of what it is about. `of`: the name of the node,
/// or `{"kind", "from", "to"}` of a link. `what`: `{"port", "label"}`, with the label of a role card where one has it. `from`,
/// `to`: numbers, texts or places. `n`: how many more commands a batch has, or how many nodes come or go.
nlohmann::ordered_json said_of_step(const ViewSources& sources, const room::Draft& draft, const Command& step);
/// A place in the same parts: `{"of", "what"}`.
nlohmann::ordered_json said_of_place(const ViewSources& sources, const room::Draft& draft, const Touch& place);
/// The name of a link for people: its kind and its ends. The id where there is no such link.
std::string name_of_link(const Scene& scene, const std::string& id);

}  // namespace bl::wire
