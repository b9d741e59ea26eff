// Every screen of a page without scripts, on one page; what is sent comes back with the answer.
#include "core/serve/plain_page.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/json_text.h"
#include "core/drawing/markup.h"
#include "core/minutes/minutes.h"
#include "core/reading/figures.h"

namespace bl::serve {

namespace {

using drawing::escape_xml;

std::map<std::string, Json> content_of(const wire::View& view) {
  std::map<std::string, Json> content;
  for (const auto& [key, text] : view) content[key] = *parse_json(text);
  return content;
}

std::string text_in(const Json& json, const char* key) {
  return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
}

std::string head(const std::string& title) {
  return "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">"
         "<title>" +
         escape_xml(title) + "</title><link rel=\"stylesheet\" href=\"/plain.css\"></head><body><main><h1>" + escape_xml(title) +
         "</h1>";
}

std::string notice_of(const std::string& text) {
  return text.empty() ? "" : "<p class=\"notice\" role=\"status\">" + escape_xml(text) + "</p>";
}

// Streets as lines, everything else as areas; volumes in the colours of their uses, with their names for who listens.
std::string plan_of(RoomHost& room) {
  const auto plan = content_of(room.view("plan", 0));
  const Json& box = plan.at("box");
  const double left = box[0].get<double>(), top = box[1].get<double>();
  const double width = std::max(1.0, box[2].get<double>() - left), height = std::max(1.0, box[3].get<double>() - top);
  const double line = std::max(width, height) / 400;
  std::string svg = "<svg class=\"plan\" role=\"img\" aria-label=\"Plan of the scene\" viewBox=\"" + shortest(left - 4 * line) +
                    " " + shortest(top - 4 * line) + " " + shortest(width + 8 * line) + " " + shortest(height + 8 * line) + "\">";
  for (const char* kind : {"boundary", "plot", "building", "street", "volume"})
    for (const auto& [key, node] : plan) {
      if (key == "box" || text_in(node, "kind") != kind) continue;
      const std::string is = kind;
      const std::string fill = is == "volume" ? text_in(node, "fill") : is == "building" ? "#c9c5ba" : "none";
      const std::string stroke = is == "volume" ? "#ffffff" : is == "street" ? "#9a958a" : "#6b675e";
      svg += "<path d=\"" + escape_xml(text_in(node, "d")) + "\" fill=\"" + escape_xml(fill) +
             "\" fill-opacity=\".85\" stroke=\"" + stroke + "\" stroke-width=\"" + shortest(is == "street" ? 3 * line : line) +
             "\"><title>" + escape_xml(text_in(node, "name")) + "</title></path>";
    }
  return svg + "</svg>";
}

// In the words of the page with scripts.
std::string status_of(const std::string& status) { return status == "met" ? "Met" : status == "close" ? "Nearly" : "Not yet"; }

std::string figures_of(RoomHost& room) {
  const auto figures = content_of(room.view("figures", 0));
  if (figures.empty()) return "";
  std::string table = "<h2>Figures</h2><table><tr><th>Goal</th><th>Now</th><th>Aim</th><th>State</th></tr>";
  for (const auto& [id, one] : figures) {
    const std::string unit = text_in(one, "unit");
    table += "<tr><td>" + escape_xml(text_in(one, "name")) + "</td><td>" +
             escape_xml(rough(one["value"].get<double>()) + " " + unit) + "</td><td>" +
             escape_xml(rough(one["target"].get<double>()) + " " + unit) + "</td><td>" + status_of(text_in(one, "status")) +
             "</td></tr>";
  }
  return table + "</table>";
}

std::string form_of(RoomHost& room, const std::string& what, const std::string& token, const std::string& inside,
                    const std::string& button) {
  return "<form method=\"post\" action=\"/plain/" + room.code() + (what.empty() ? "" : "/" + what) +
         "\"><input type=\"hidden\" name=\"token\" value=\"" + escape_xml(token) + "\">" + inside + "<button>" +
         escape_xml(button) + "</button></form>";
}

// Where the session was ended so that whoever took part may read them.
std::string minutes_form(const RoomHost& room, std::int64_t seat, const std::string& token) {
  const std::string file(minutes::kMinutesPage);
  if (!room.may_read_minutes(seat, file)) return "";
  const auto field = [](const std::string& name, const std::string& value) {
    return "<input type=\"hidden\" name=\"" + name + "\" value=\"" + escape_xml(value) + "\">";
  };
  return "<form method=\"post\" action=\"/minutes\">" + field("room", room.code()) + field("token", token) + field("file", file) +
         "<button>Open the minutes</button></form>";
}

std::string choice(const std::string& name, const std::string& value, const std::string& label, bool is_chosen) {
  return "<label class=\"choice\"><input type=\"radio\" name=\"" + name + "\" value=\"" + escape_xml(value) + "\"" +
         (is_chosen ? " checked" : "") + " required> " + escape_xml(label) + "</label>";
}

std::string number_field(const std::string& name, const std::string& label, double least, double most, const Json& value) {
  return "<label>" + escape_xml(label) + "<input type=\"number\" name=\"" + escape_xml(name) + "\" min=\"" + shortest(least) +
         "\" max=\"" + shortest(most) + "\" step=\"any\"" +
         (value.is_number() ? " value=\"" + shortest(value.get<double>()) + "\"" : "") + "></label>";
}

constexpr std::int64_t kMostDotFields = 10;

std::string dot_field(std::int64_t number, const char* part) { return "d" + std::to_string(number) + "_" + part; }

// The place of a thing on the plan: the middle of the box around its outline. Outlines are relative steps with y downwards.
std::optional<std::pair<double, double>> middle_of(const std::string& outline) {
  double x = 0, y = 0, low_x = 1e300, high_x = -1e300, low_y = 1e300, high_y = -1e300;
  std::string numbers = outline;
  for (char& letter : numbers)
    if (letter == 'M' || letter == 'l' || letter == 'z') letter = letter == 'M' ? '|' : ' ';
  std::size_t at = 0;
  bool is_absolute = false;
  std::vector<double> pair;
  while (at < numbers.size()) {
    if (numbers[at] == '|' || numbers[at] == ' ') {
      is_absolute = is_absolute || numbers[at] == '|';
      ++at;
      continue;
    }
    const std::size_t end = std::min(numbers.find_first_of("| ", at), numbers.size());
    const auto number = parse_number(numbers.substr(at, end - at));
    at = end;
    if (!number) return std::nullopt;
    pair.push_back(*number);
    if (pair.size() < 2) continue;
    x = is_absolute ? pair[0] : x + pair[0];
    y = is_absolute ? pair[1] : y + pair[1];
    is_absolute = false;
    pair.clear();
    low_x = std::min(low_x, x), high_x = std::max(high_x, x), low_y = std::min(low_y, y), high_y = std::max(high_y, y);
  }
  if (low_x > high_x) return std::nullopt;
  return std::pair((low_x + high_x) / 2, -(low_y + high_y) / 2);
}

std::string option_of(const std::string& value, const std::string& label, bool is_chosen) {
  return "<option value=\"" + escape_xml(value) + "\"" + (is_chosen ? " selected" : "") + ">" + escape_xml(label) + "</option>";
}

// Each dot says what it means, and where it stands: on a thing of the plan, or at a place in metres.
std::string dot_fields(RoomHost& room, const Json& vote) {
  const auto plan = content_of(room.view("plan", 0));
  const Json& mine = vote["mine"];
  const std::int64_t most = std::min(vote["points"].get<std::int64_t>(), kMostDotFields);
  std::vector<std::pair<std::string, std::string>> meanings;
  for (const Json& option : vote["options"])
    meanings.emplace_back(text_in(option, "id"),
                          text_in(option, "label").empty() ? text_in(option, "id") : text_in(option, "label"));
  if (meanings.empty()) meanings = {{"plus", "Good here"}, {"minus", "Not here"}};
  std::string inside = "<p>You have " + std::to_string(most) + (most == 1 ? " dot." : " dots.") +
                       " Choose a thing for each, or say where it is in metres east and north.</p>";
  for (std::int64_t number = 1; number <= most; ++number) {
    const Json dot =
        mine.is_array() && static_cast<std::size_t>(number) <= mine.size() ? mine[static_cast<std::size_t>(number) - 1] : Json();
    std::string options = option_of("", "not used", dot.is_null()), what;
    for (const auto& [id, label] : meanings) what += option_of(id, label, dot.is_object() && dot["option"] == id);
    options += option_of("=", "the place below", dot.is_object());
    for (const auto& [key, thing] : plan)
      if (key.starts_with("n/") && text_in(thing, "kind") != "street")
        options += option_of(key.substr(2), text_in(thing, "name"), false);
    inside += "<fieldset><legend>Dot " + std::to_string(number) + "</legend><label>Where<select name=\"" +
              dot_field(number, "on") + "\">" + options + "</select></label><label>What<select name=\"" +
              dot_field(number, "is") + "\">" + what + "</select></label>" +
              number_field(dot_field(number, "x"), "Metres east", -1e6, 1e6, dot.is_object() ? dot["place"][0] : Json()) +
              number_field(dot_field(number, "y"), "Metres north", -1e6, 1e6, dot.is_object() ? dot["place"][1] : Json()) +
              "</fieldset>";
  }
  return inside;
}

// The dots of the form, or what is missing in it.
std::variant<Json, std::string> dots_in(RoomHost& room, const Json& vote, const std::map<std::string, std::string>& fields) {
  const auto plan = content_of(room.view("plan", 0));
  const auto field = [&](std::int64_t number, const char* part) {
    const auto found = fields.find(dot_field(number, part));
    return found == fields.end() ? std::string() : found->second;
  };
  Json dots = Json::array();
  for (std::int64_t number = 1; number <= std::min(vote["points"].get<std::int64_t>(), kMostDotFields); ++number) {
    const std::string on = field(number, "on"), name = "dot " + std::to_string(number);
    if (on.empty()) continue;
    std::optional<std::pair<double, double>> place;
    if (on == "=") {
      const auto x = parse_number(field(number, "x")), y = parse_number(field(number, "y"));
      if (!x || !y) return "Not taken: say how many metres east and north " + name + " is.";
      place = std::pair(*x, *y);
    } else if (const auto thing = plan.find("n/" + on); thing != plan.end()) place = middle_of(text_in(thing->second, "d"));
    if (!place) return "Not taken: the thing of " + name + " is not on the plan any more.";
    dots.push_back({{"place", {place->first, place->second, 0}}, {"option", field(number, "is")}});
  }
  return dots;
}

std::string ballot_fields(RoomHost& room, const Json& vote) {
  const std::string kind = text_in(vote, "kind");
  const Json& mine = vote["mine"];
  std::string inside;
  if (kind == "dots") return dot_fields(room, vote);
  if (kind == "yes_no") return choice("answer", "yes", "Yes", mine == "yes") + choice("answer", "no", "No", mine == "no");
  if (kind == "slider")
    return number_field("value",
                        "From " + shortest(vote["least"].get<double>()) + " to " + shortest(vote["most"].get<double>()) + " " +
                            text_in(vote, "unit"),
                        vote["least"].get<double>(), vote["most"].get<double>(), mine);
  for (std::size_t k = 0; k < vote["options"].size(); ++k) {
    const Json& option = vote["options"][k];
    const std::string id = text_in(option, "id"), label = text_in(option, "label").empty() ? id : text_in(option, "label");
    Json value;
    if (kind == "coins" && mine.is_object() && mine.contains(id)) value = mine[id];
    if (kind == "rank" && mine.is_array())
      for (std::size_t place = 0; place < mine.size(); ++place)
        if (mine[place] == id) value = place + 1;
    const double most = kind == "rank" ? static_cast<double>(vote["options"].size()) : vote["points"].get<double>();
    inside += number_field("o_" + id, label, kind == "rank" ? 1 : 0, most, value);
  }
  return inside;
}

// Numbers have no shares: their mean and their median say what people want.
std::string result_of(const Json& vote) {
  if (text_in(vote, "kind") == "slider") {
    if (!vote["mean"].is_number() || !vote["median"].is_number() || vote["count"] == 0) return "";
    const auto row = [&vote](const char* label, const char* key) {
      return std::string("<tr><td>") + label + "</td><td>" +
             escape_xml(rough(vote[key].get<double>()) + " " + text_in(vote, "unit")) + "</td></tr>";
    };
    return "<table>" + row("Mean", "mean") + row("Median", "median") + "</table>";
  }
  if (!vote["result"].is_array()) return "";
  std::string table = "<table><tr><th>Answer</th><th>Points</th><th>Share</th></tr>";
  for (const Json& row : vote["result"])
    table += "<tr><td>" + escape_xml(text_in(row, "label").empty() ? text_in(row, "option") : text_in(row, "label")) +
             "</td><td>" + rough(row["points"].get<double>()) + "</td><td>" + fixed(100 * row["share"].get<double>(), 0) +
             " %</td></tr>";
  return table + "</table>";
}

std::string vote_of(RoomHost& room, const std::string& id, const Json& vote, const std::string& token) {
  std::string page = "<section><h2>" + escape_xml(text_in(vote, "question")) + "</h2>";
  const std::string kind = text_in(vote, "kind");
  if (vote["open"] == true) {
    const char* how = kind == "rank" ? "<p>Give 1 to the best, 2 to the next, and so on.</p>" : "";
    const std::string coins = kind == "coins" ? "<p>You have " + shortest(vote["points"].get<double>()) + " coins.</p>" : "";
    page += how + coins +
            form_of(room, "vote", token,
                    "<input type=\"hidden\" name=\"vote\" value=\"" + escape_xml(id) + "\">" + ballot_fields(room, vote), "Vote");
  } else page += "<p>This vote is closed.</p>";
  const auto count = vote["count"].get<std::size_t>();
  return page + result_of(vote) + "<p>" + reading::counted(count, "ballot") + (count == 1 ? " is" : " are") +
         " counted.</p></section>";
}

// What can be done comes before what is over.
std::string votes_of(RoomHost& room, std::int64_t seat, const std::string& token, const PlainWish* taken) {
  std::string page;
  auto votes = content_of(room.view("votes", seat));
  if (taken != nullptr && taken->kind == room::OperationKind::command) {
    const Json& said = (**taken->content.read()).at("arguments");
    if (const auto vote = votes.find(text_in(said, "node")); vote != votes.end()) vote->second["mine"] = said.at("ballot");
  }
  for (const bool is_open : {true, false})
    for (const auto& [id, vote] : votes)
      if ((vote["open"] == true) == is_open) page += vote_of(room, id, vote, token);
  return page;
}

std::string comments_of(RoomHost& room, std::int64_t seat, const std::string& token) {
  std::string options = "<option value=\"\">the whole</option>";
  for (const auto& [key, node] : content_of(room.view("plan", 0)))
    if (key.starts_with("n/") && text_in(node, "kind") == "volume")
      options += "<option value=\"" + escape_xml(key.substr(2)) + "\">" + escape_xml(text_in(node, "name")) + "</option>";
  std::string page = "<section><h2>Comments</h2>" + form_of(room, "comment", token,
                                                            "<label>About<select name=\"node\">" + options +
                                                                "</select></label><label>Your comment<textarea name=\"text\" "
                                                                "maxlength=\"2000\" rows=\"4\" required></textarea></label>",
                                                            "Send");
  for (const auto& [id, comment] : content_of(room.view("comments", seat))) {
    page += "<blockquote><p>" + escape_xml(text_in(comment, "text")) + "</p>";
    if (!text_in(comment, "answer").empty()) page += "<p>Answer: " + escape_xml(text_in(comment, "answer")) + "</p>";
    page += "</blockquote>";
  }
  return page + "</section>";
}

}  // namespace

std::string plain_style() {
  return "body{margin:0;font:1.05rem/1.5 "
         "system-ui,sans-serif;color:#1f242e;background:#fcfbf8}main{max-width:42rem;margin:auto;padding:1rem}"
         "h1{font-size:1.4rem}h2{font-size:1.15rem;margin:1.6rem 0 .4rem}label{display:block;margin:.7rem "
         "0}.choice{padding:.6rem 0;min-height:1.6rem}"
         "input:not([type=radio]),select,textarea{display:block;width:100%;box-sizing:border-box;font:inherit;padding:.6rem;"
         "border:1px solid #6b675e;border-radius:.4rem;background:#fff;color:inherit}"
         "fieldset{margin:1rem 0;border:1px solid #6b675e;border-radius:.4rem}"
         "input[type=radio]{width:1.5rem;height:1.5rem;vertical-align:middle}button{font:inherit;min-height:3rem;padding:.6rem "
         "1.4rem;border:0;border-radius:.5rem;background:#1b4f72;color:#fff}"
         ":focus-visible{outline:3px solid "
         "#d55e00;outline-offset:2px}table{border-collapse:collapse;width:100%}td,th{text-align:left;padding:.3rem .6rem .3rem "
         "0;border-bottom:1px solid #d9d5ca}"
         ".plan{width:100%;max-height:70vh;background:#fff;border:1px solid #d9d5ca}.notice{padding:.7rem "
         "1rem;background:#e7f0f6;border-left:4px solid #1b4f72}blockquote{margin:1rem 0;padding:.2rem 1rem;border-left:3px "
         "solid #d9d5ca}"
         "@media "
         "(prefers-color-scheme:dark){body{background:#16181d;color:#ece9e2}input:not([type=radio]),select,textarea{background:#"
         "22252c}button{background:#7fb8dd;color:#10141a}.plan{background:#e9e6de}.notice{background:#22303a;border-color:#"
         "7fb8dd}}";
}

std::string plain_door(RoomHost& room, const std::string& notice) {
  return head(room.title()) + notice_of(notice) + plan_of(room) +
         "<p>You take part under the name of an animal; your own name is not asked for. What you change and say is stored with "
         "the session. "
         "Everybody in this network can read along.</p>" +
         form_of(room, "join", "", "", "Take part") + "</main></body></html>";
}

std::string plain_room(RoomHost& room, std::int64_t seat, const std::string& token, const std::string& notice,
                       const PlainWish* taken) {
  const auto about = content_of(room.view("room", seat));
  const Json& own = about.at("seats")[std::to_string(seat)];
  const std::string phase = text_in(about.at("phase"), "name");
  return head(room.title()) + notice_of(notice) + "<p>You are <strong>" + escape_xml(text_in(own, "name")) + "</strong>." +
         (phase.empty() ? "" : " Now: " + escape_xml(phase) + ".") + "</p>" + plan_of(room) +
         form_of(room, "", token, "", "Show it as it is now") + figures_of(room) + votes_of(room, seat, token, taken) +
         comments_of(room, seat, token) + minutes_form(room, seat, token) + "</main></body></html>";
}

std::variant<PlainWish, std::string> wish_of_vote(RoomHost& room, std::int64_t seat,
                                                  const std::map<std::string, std::string>& fields) {
  const auto votes = content_of(room.view("votes", seat));
  const auto vote = fields.contains("vote") ? votes.find(fields.at("vote")) : votes.end();
  if (vote == votes.end()) return std::string("There is no such vote any more.");
  const std::string kind = text_in(vote->second, "kind");
  Json ballot;
  if (kind == "yes_no") ballot = fields.contains("answer") ? Json(fields.at("answer")) : Json();
  else if (kind == "slider") {
    const auto number = fields.contains("value") ? parse_number(fields.at("value")) : std::nullopt;
    if (!number) return std::string("Not taken: say a number.");
    ballot = *number;
  } else if (kind == "dots") {
    auto dots = dots_in(room, vote->second, fields);
    if (auto* missing = std::get_if<std::string>(&dots)) return std::move(*missing);
    ballot = std::move(std::get<Json>(dots));
  } else {
    std::map<double, std::string> ranks;
    Json coins = Json::object();
    for (const Json& option : vote->second["options"]) {
      const std::string id = text_in(option, "id");
      const auto field = fields.find("o_" + id);
      if (field == fields.end() || field->second.empty()) continue;
      const auto number = parse_number(field->second);
      if (!number) return "Not taken: `" + field->second + "` is no number.";
      if (kind == "rank" && !ranks.emplace(*number, id).second) return std::string("Not taken: two answers have the same rank.");
      if (*number != 0) coins[id] = *number;
    }
    ballot = kind == "coins" ? coins : Json::array();
    if (kind == "rank")
      for (const auto& [rank, id] : ranks) ballot.push_back(id);
  }
  if (ballot.is_null() || ballot.empty()) return std::string("Not taken: choose an answer first.");
  return PlainWish{
      room::OperationKind::command,
      JsonValue::of(
          {{"command", "cast_vote"},
           {"arguments", {{"node", vote->first}, {"voter", room::RoomState::author_of_seat(seat)}, {"ballot", ballot}}}})};
}

std::variant<PlainWish, std::string> wish_of_comment(RoomHost& room, std::int64_t seat,
                                                     const std::map<std::string, std::string>& fields) {
  const std::string text = fields.contains("text") ? fields.at("text") : "";
  if (text.find_first_not_of(" \r\n\t") == std::string::npos) return std::string("Not taken: write something first.");
  std::string plain;
  for (const char c : text)
    if (c != '\r') plain += c;
  Json arguments = {{"id", "c" + std::to_string(seat) + "-" + std::to_string(room.view("comments", seat).size() + 1)},
                    {"text", plain}};
  if (fields.contains("node") && !fields.at("node").empty()) arguments["node"] = fields.at("node");
  return PlainWish{room::OperationKind::event, JsonValue::of({{"event", "comment"}, {"arguments", arguments}})};
}

}  // namespace bl::serve
