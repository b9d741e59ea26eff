// Networks, trip tables, flows and node places from the lines of TNTP files.
#include "core/import/tntp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

#include "core/base/plural.h"
#include "core/base/text.h"
#include "core/import/tntp_lines.h"

namespace bl::importing {

namespace {

// Node numbers above this are mistakes, not networks.
constexpr double kMostNodes = 5e6;

// Where the wanted columns stand: as named, or in the order of the format's description.
struct TntpColumn {
  std::string_view what;
  std::array<std::string_view, 6> names;
  std::size_t usual;
  std::optional<double> missing;  // empty: the column is needed
};

std::vector<std::size_t> places_of(std::span<const TntpColumn> columns, const std::vector<std::string>& names) {
  std::vector<std::size_t> places;
  std::size_t known = 0;
  for (const TntpColumn& column : columns) {
    std::size_t place = names.size();
    for (const std::string_view name : column.names)
      if (place == names.size() && !name.empty())
        place = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    known += place < names.size() ? 1 : 0;
    places.push_back(place);
  }
  // Names count only where all needed columns are among them; comments say many things.
  bool is_named = known >= 2;
  for (std::size_t c = 0; c < columns.size(); ++c) is_named = is_named && (columns[c].missing || places[c] < names.size());
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (!is_named) places[c] = columns[c].usual;
    else if (places[c] == names.size()) places[c] = SIZE_MAX;
  return places;
}

// The numbers of one row by column.
Result<std::vector<double>> row_of(const TntpLine& line, std::span<const TntpColumn> columns,
                                   std::span<const std::size_t> places) {
  std::vector<double> row;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (places[c] >= line.fields.size()) {
      if (!columns[c].missing)
        return Error{
            ErrorCode::missing, tntp_line_place(line.number),
            "the row ends before its " + std::string(columns[c].what) + "; expected column " + std::to_string(places[c] + 1)};
      row.push_back(*columns[c].missing);
      continue;
    }
    const auto number = parse_number(line.fields[places[c]]);
    if (!number)
      return Error{ErrorCode::parse, tntp_line_place(line.number),
                   "expected a number as the " + std::string(columns[c].what) + ", found `" +
                       std::string(line.fields[places[c]].substr(0, 40)) + "`"};
    row.push_back(*number);
  }
  return row;
}

Result<std::string> node_name(double number, int line) {
  if (!(number >= 1 && number <= kMostNodes) || number != std::floor(number))
    return Error{ErrorCode::out_of_range, tntp_line_place(line),
                 "`" + shortest(number) + "` is no node number; nodes are counted from 1"};
  return std::to_string(static_cast<std::int64_t>(number));
}

Result<std::int64_t> count_of(const TntpText& text, const std::string& name, std::int64_t missing) {
  const auto number = tntp_metadata_number(text, name, static_cast<double>(missing));
  if (!number) return number.error();
  if (!(*number >= 0 && *number <= kMostNodes) || *number != std::floor(*number))
    return Error{ErrorCode::out_of_range, "<" + name + ">", "expects a whole number from 0 to 5 000 000"};
  return static_cast<std::int64_t>(*number);
}

const std::array<TntpColumn, 9> kLinkColumns = {
    TntpColumn{"node it begins at", {"initnode", "from", "tail", "init", "fromnode", "a"}, 0, {}},
    TntpColumn{"node it ends at", {"termnode", "to", "head", "term", "tonode", "b_node"}, 1, {}},
    TntpColumn{"capacity", {"capacity", "cap"}, 2, {}},
    TntpColumn{"length", {"length", "distance"}, 3, 0.0},
    TntpColumn{"free flow time", {"freeflowtime", "fft", "freetime", "time"}, 4, {}},
    TntpColumn{"factor B", {"b", "alpha"}, 5, 0.15},
    TntpColumn{"power", {"power", "beta"}, 6, 4.0},
    TntpColumn{"toll", {"toll"}, 8, 0.0},
    TntpColumn{"type", {"linktype", "type"}, 9, 0.0},
};

Result<traffic::TrafficLink> link_of(const TntpLine& line, std::span<const std::size_t> places,
                                     std::map<std::string, int>& twins) {
  const auto row = row_of(line, kLinkColumns, places);
  if (!row) return row.error();
  const auto from = node_name((*row)[0], line.number), to = node_name((*row)[1], line.number);
  if (!from) return from.error();
  if (!to) return to.error();
  traffic::TrafficLink link{"", *from, *to, (*row)[4], (*row)[2], (*row)[5], (*row)[6], (*row)[3], (*row)[7], true};
  link.id = link.from + "-" + link.to;
  if (const int count = ++twins[link.id]; count > 1) link.id += "#" + std::to_string(count);
  for (const double number : {link.free_time, link.capacity, link.alpha, link.power, link.length})
    if (number < 0)
      return Error{ErrorCode::out_of_range, tntp_line_place(line.number),
                   "capacity, length, time, B and power of a link have to be 0 or more"};
  if (link.capacity == 0 && link.free_time > 0 && link.alpha > 0)
    return Error{ErrorCode::out_of_range, tntp_line_place(line.number),
                 "the capacity has to be above 0, or B has to be 0 where the time does not depend on the flow"};
  return link;
}

// Counts that files promise are sometimes off by a few; a file that was cut off lacks more, or ends within a row.
constexpr double kLackTolerated = 0.01;

Result<void> check_whole(const TntpText& text, const std::string& promise, double promised, double held,
                         const std::string& what) {
  const std::string remedy = ". Fetch it again";
  if (text.is_cut_off)
    return Error{ErrorCode::parse, tntp_line_place(text.lines.back().number),
                 "the last row lacks the `;` that ends every other one: the file is cut off here" + remedy};
  if (promised - held > kLackTolerated * promised)
    return Error{ErrorCode::missing, "<" + promise + ">",
                 "the file promises " + shortest(promised) + " " + what + " and holds " + shortest(held) + ": it is cut off" +
                     remedy + ", or correct this line if it is wrong"};
  return {};
}

}  // namespace

Result<TntpNetwork> read_tntp_network(std::string_view text) {
  const auto split = split_tntp(text);
  if (!split) return split.error();
  TntpNetwork out;
  const auto zones = count_of(*split, "NUMBER OF ZONES", 0), nodes = count_of(*split, "NUMBER OF NODES", 0);
  const auto links = count_of(*split, "NUMBER OF LINKS", 0), through = count_of(*split, "FIRST THRU NODE", 1);
  const auto toll = tntp_metadata_number(*split, "TOLL FACTOR", 0), distance = tntp_metadata_number(*split, "DISTANCE FACTOR", 0);
  for (const auto* count : {&zones, &nodes, &links, &through})
    if (!*count) return count->error();
  for (const auto* factor : {&toll, &distance})
    if (!*factor) return factor->error();
  out.zones = *zones;
  out.factors = {*toll, *distance};
  if (!split->metadata.contains("FIRST THRU NODE"))
    out.notes.push_back("The file does not say which node is the first that trips may pass; all may be passed.");
  const auto places = places_of(kLinkColumns, split->columns);
  std::map<std::string, int> twins;
  std::int64_t last = std::max(*zones, *nodes), loops = 0;
  for (const TntpLine& line : split->lines) {
    auto link = link_of(line, places, twins);
    if (!link && out.links.empty())
      return Error{link.error().code, link.error().place, link.error().message + "; is this the `_net` file?"};
    if (!link) return link.error();
    for (const std::string* end : {&link->from, &link->to}) last = std::max(last, static_cast<std::int64_t>(*parse_number(*end)));
    if (link->from == link->to) ++loops;
    else out.links.push_back(std::move(*link));
  }
  if (split->lines.empty()) return Error{ErrorCode::missing, "", "the network has no links; is this the `_net` file?"};
  if (auto whole =
          check_whole(*split, "NUMBER OF LINKS", static_cast<double>(*links), static_cast<double>(split->lines.size()), "links");
      !whole)
    return whole.error();
  if (split->metadata.contains("NUMBER OF NODES") && last > *nodes)
    out.notes.push_back("The file promises " + std::to_string(*nodes) + " nodes and names node " + std::to_string(last) +
                        "; all are taken.");
  if (split->metadata.contains("NUMBER OF LINKS") && *links != static_cast<std::int64_t>(split->lines.size()))
    out.notes.push_back("The file promises " + std::to_string(*links) + " links and holds " +
                        std::to_string(split->lines.size()) + "; these are taken.");
  if (loops > 0)
    out.notes.push_back(
        how_many(static_cast<std::size_t>(loops), "link") +
        by_number(static_cast<std::size_t>(loops), " ends where it begins and was", " end where they begin and were") +
        " left out: nobody gets anywhere that way.");
  for (std::int64_t n = 1; n <= last; ++n) out.nodes.push_back({std::to_string(n), n >= *through});
  return out;
}

namespace {

// Pairs `destination : trips ;` of one line, behind each other.
Result<void> read_trip_line(const TntpLine& line, const std::string& origin, TntpTrips& out) {
  if (origin.empty())
    return Error{ErrorCode::parse, tntp_line_place(line.number),
                 "trips stand before the first `Origin`; is this the `_trips` file?"};
  if (line.fields.size() % 2 != 0)
    return Error{ErrorCode::parse, tntp_line_place(line.number),
                 "expected pairs `destination : trips;`, found an odd number of entries"};
  for (std::size_t f = 0; f < line.fields.size(); f += 2) {
    const auto destination = parse_number(line.fields[f]), trips = parse_number(line.fields[f + 1]);
    if (!destination || !trips)
      return Error{ErrorCode::parse, tntp_line_place(line.number),
                   "expected `destination : trips;`, found `" + std::string(line.fields[f].substr(0, 40)) + "` and `" +
                       std::string(line.fields[f + 1].substr(0, 40)) + "`"};
    const auto name = node_name(*destination, line.number);
    if (!name) return name.error();
    if (*trips < 0)
      return Error{ErrorCode::out_of_range, tntp_line_place(line.number), "trips to zone " + *name + " have to be 0 or more"};
    out.total += *trips;
    if (*trips > 0) out.entries.push_back({origin, *name, *trips});
  }
  return {};
}

bool is_origin(std::string_view word) {
  constexpr std::string_view kWord = "origin";
  return word.size() == kWord.size() &&
         std::equal(word.begin(), word.end(), kWord.begin(), [](char a, char b) { return (a | 0x20) == b; });
}

}  // namespace

Result<TntpTrips> read_tntp_trips(std::string_view text) {
  const auto split = split_tntp(text);
  if (!split) return split.error();
  TntpTrips out;
  const auto zones = count_of(*split, "NUMBER OF ZONES", 0);
  if (!zones) return zones.error();
  out.zones = *zones;
  std::string origin;
  bool is_any = false;
  for (TntpLine line : split->lines) {
    if (is_origin(line.fields.front())) {
      const auto number = line.fields.size() > 1 ? parse_number(line.fields[1]) : std::nullopt;
      if (!number) return Error{ErrorCode::parse, tntp_line_place(line.number), "expected the number of a zone behind `Origin`"};
      auto name = node_name(*number, line.number);
      if (!name) return name.error();
      origin = std::move(*name);
      is_any = true;
      line.fields.erase(line.fields.begin(), line.fields.begin() + 2);
    }
    if (auto done = read_trip_line(line, origin, out); !done) return done.error();
  }
  if (!is_any) return Error{ErrorCode::missing, "", "there is no `Origin` in the text; is this the `_trips` file?"};
  const auto promised = tntp_metadata_number(*split, "TOTAL OD FLOW", out.total);
  if (!promised) return promised.error();
  if (auto whole = check_whole(*split, "TOTAL OD FLOW", *promised, out.total, "trips"); !whole) return whole.error();
  if (std::abs(*promised - out.total) > 1e-6 * std::max(1.0, out.total))
    out.notes.push_back("The file promises " + shortest(*promised) + " trips and holds " + shortest(out.total) +
                        "; these are taken.");
  return out;
}

Result<TntpFlows> read_tntp_flows(std::string_view text) {
  static const std::array<TntpColumn, 4> kColumns = {
      TntpColumn{"node it begins at", {"from", "tail", "initnode", "fromnode"}, 0, {}},
      TntpColumn{"node it ends at", {"to", "head", "termnode", "tonode"}, 1, {}},
      TntpColumn{"volume", {"volume", "flow", "volumecapacity"}, 2, {}},
      TntpColumn{"cost", {"cost", "time", "traveltime"}, 3, 0.0},
  };
  const auto split = split_tntp(text);
  if (!split) return split.error();
  const auto places = places_of(kColumns, split->columns);
  TntpFlows out;
  for (const TntpLine& line : split->lines) {
    const auto row = row_of(line, kColumns, places);
    if (!row) return row.error();
    const auto from = node_name((*row)[0], line.number), to = node_name((*row)[1], line.number);
    if (!from) return from.error();
    if (!to) return to.error();
    out.entries.push_back({*from, *to, (*row)[2], (*row)[3]});
  }
  if (out.entries.empty()) return Error{ErrorCode::missing, "", "there are no flows in the text; is this the `_flow` file?"};
  return out;
}

Result<TntpPlaces> read_tntp_places(std::string_view text) {
  static const std::array<TntpColumn, 3> kColumns = {
      TntpColumn{"node", {"node", "id", "nodeid"}, 0, {}},
      TntpColumn{"x", {"x", "xcoord", "lon", "longitude"}, 1, {}},
      TntpColumn{"y", {"y", "ycoord", "lat", "latitude"}, 2, {}},
  };
  const auto split = split_tntp(text);
  if (!split) return split.error();
  const auto places = places_of(kColumns, split->columns);
  TntpPlaces out;
  for (const TntpLine& line : split->lines) {
    const auto row = row_of(line, kColumns, places);
    if (!row) return row.error();
    const auto node = node_name((*row)[0], line.number);
    if (!node) return node.error();
    out.entries.push_back({*node, (*row)[1], (*row)[2]});
  }
  if (out.entries.empty()) return Error{ErrorCode::missing, "", "there are no nodes in the text; is this the `_node` file?"};
  return out;
}

}  // namespace bl::importing
