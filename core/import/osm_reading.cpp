// OpenStreetMap files by libosmium, from memory; its exceptions end here.
#include <algorithm>
#include <charconv>
#include <exception>
#include <new>
#include <osmium/io/pbf_input.hpp>
#include <osmium/io/reader.hpp>
#include <osmium/io/xml_input.hpp>
#include <osmium/osm.hpp>
#include <osmium/thread/pool.hpp>
#include <set>
#include <system_error>

#include "core/base/foreign_bytes.h"
#include "core/define/bounded_json.h"
#include "core/import/inflate.h"
#include "core/import/osm_store.h"
#include "core/import/pbf_blocks.h"

namespace bl::importing {

namespace {

OsmTags tags_of(const osmium::TagList& list) {
  OsmTags tags;
  for (const osmium::Tag& tag : list) tags.emplace(tag.key(), tag.value());
  return tags;
}

using Names = std::set<std::pair<char, std::int64_t>>;

// The value of an attribute within a start tag, or nothing.
std::string_view attribute(std::string_view tag, std::string_view name) {
  for (std::size_t at = tag.find(name); at != std::string_view::npos; at = tag.find(name, at + 1)) {
    const std::size_t equals = at + name.size();
    if (at == 0 || (tag[at - 1] != ' ' && tag[at - 1] != '\t' && tag[at - 1] != '\n') || equals + 1 >= tag.size() ||
        tag[equals] != '=')
      continue;
    const std::size_t end = tag.find(tag[equals + 1], equals + 2);
    return end == std::string_view::npos ? std::string_view() : tag.substr(equals + 2, end - equals - 2);
  }
  return {};
}

// What JOSM has marked for deletion by action="delete", which libosmium passes over. In XML `<` begins a tag and nothing else.
Names unwanted_of(std::string_view xml) {
  Names names;
  constexpr std::string_view kWord = "action=";
  std::size_t done = 0;
  for (std::size_t at = xml.find(kWord); at != std::string_view::npos; at = xml.find(kWord, done)) {
    const std::size_t begin = xml.substr(done, at - done).rfind('<'), end = xml.find('>', at);
    const std::size_t from = done;
    if (end == std::string_view::npos) break;
    done = end;
    if (begin == std::string_view::npos) continue;
    const std::string_view tag = xml.substr(from + begin + 1, end - from - begin - 1);
    const char kind = tag.starts_with("node ") ? 'n' : tag.starts_with("way ") ? 'w' : tag.starts_with("relation ") ? 'r' : ' ';
    const std::string_view id = attribute(tag, "id");
    std::int64_t number = 0;
    if (kind == ' ' || attribute(tag, "action") != "delete") continue;
    if (std::from_chars(id.data(), id.data() + id.size(), number).ec == std::errc()) names.emplace(kind, number);
  }
  return names;
}

void take(const osmium::memory::Buffer& buffer, const Names& unwanted, OsmStore& store) {
  for (const auto& item : buffer) {
    if (item.type() == osmium::item_type::node) {
      const auto& node = static_cast<const osmium::Node&>(item);
      const osmium::Location place = node.location();
      OsmNode& taken = store.nodes.emplace_back();
      taken.id = node.id();
      taken.is_deleted = node.deleted() || unwanted.contains({'n', taken.id});
      taken.has_position = place.valid();
      if (taken.has_position) taken.longitude = place.lon_without_check(), taken.latitude = place.lat_without_check();
      taken.tags = tags_of(node.tags());
    } else if (item.type() == osmium::item_type::way) {
      const auto& way = static_cast<const osmium::Way&>(item);
      OsmWay& taken = store.ways.emplace_back();
      taken.id = way.id();
      taken.is_deleted = way.deleted() || unwanted.contains({'w', taken.id});
      for (const osmium::NodeRef& ref : way.nodes()) taken.nodes.push_back(ref.ref());
      taken.tags = tags_of(way.tags());
    } else if (item.type() == osmium::item_type::relation) {
      const auto& relation = static_cast<const osmium::Relation&>(item);
      OsmRelation& taken = store.relations.emplace_back();
      taken.id = relation.id();
      taken.is_deleted = relation.deleted() || unwanted.contains({'r', taken.id});
      for (const osmium::RelationMember& member : relation.members())
        taken.members.push_back({osmium::item_type_to_char(member.type()), member.ref(), member.role()});
      taken.tags = tags_of(relation.tags());
    }
  }
}

// Ascending ids, of each the last one in the file; returns how many were dropped.
template <class Element>
std::size_t sort_and_keep_last(std::vector<Element>& list) {
  std::stable_sort(list.begin(), list.end(), [](const Element& a, const Element& b) { return a.id < b.id; });
  std::vector<Element> kept;
  kept.reserve(list.size());
  for (Element& element : list) {
    if (!kept.empty() && kept.back().id == element.id) kept.back() = std::move(element);
    else kept.push_back(std::move(element));
  }
  const std::size_t dropped = list.size() - kept.size();
  list = std::move(kept);
  return dropped;
}

template <class Element>
void drop_deleted(char kind, std::vector<Element>& list, OsmStore& store) {
  for (const Element& element : list)
    if (element.is_deleted) store.deleted.emplace_back(kind, element.id);
  std::erase_if(list, [](const Element& element) { return element.is_deleted; });
}

// So little of a file that it could become one: `<?xm`, or the first bytes of a PBF.
bool is_beginning_of_osm(std::string_view bytes) {
  constexpr std::string_view kPbf("\0\0\0", 3), kType("\x0a\x09OSMHeader");
  if (bytes.size() < 15 && bytes.substr(0, 3) == kPbf.substr(0, bytes.size()))
    return bytes.size() <= 4 || kType.starts_with(bytes.substr(4));
  const std::size_t start = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (start == std::string_view::npos) return false;
  const std::string_view head = bytes.substr(start);
  return std::string_view("<?xml").starts_with(head) || std::string_view("<osm").starts_with(head);
}

// The format by the first bytes; empty where it is none of OpenStreetMap.
std::string format_of(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, 4096);
  if (head.substr(0, 64).find("OSMHeader") != std::string_view::npos) return "pbf";
  const std::size_t start = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (start == std::string_view::npos || head[start] != '<') return {};
  return head.find("<osm") != std::string_view::npos || head.find("<?xml") != std::string_view::npos ? "osm" : "";
}

// libosmium multiplies by ten for each step of an exponent, beyond what its integers hold. No degree needs a positive one, and
// none is written with character references.
Result<void> check_coordinates(std::string_view xml) {
  constexpr std::string_view kSpace = " \t\r\n";
  for (const std::string_view name : {"lat", "lon"})
    for (std::size_t at = xml.find(name); at != std::string_view::npos; at = xml.find(name, at + 1)) {
      const std::size_t equals = xml.find_first_not_of(kSpace, at + name.size());
      if (equals == std::string_view::npos || xml[equals] != '=') continue;
      const std::size_t quote = xml.find_first_not_of(kSpace, equals + 1);
      if (quote == std::string_view::npos || (xml[quote] != '"' && xml[quote] != '\'')) continue;
      const std::string_view value = xml.substr(quote + 1, std::min(xml.find(xml[quote], quote + 1), xml.size()) - quote - 1);
      const std::size_t exponent = value.find_first_of("eE");
      const bool is_large = exponent != std::string_view::npos && exponent + 1 < value.size() && value[exponent + 1] != '-';
      if (is_large || value.find('&') != std::string_view::npos)
        return Error{ErrorCode::parse, place_in_text(xml, quote + 1),
                     "`" + std::string(value.substr(0, 40)) + "` is no coordinate in degrees: the file is damaged."};
    }
  return {};
}

Result<OsmStore> read(const std::string& bytes, const std::string& format, ImportWatch* watch) {
  OsmStore store;
  if (format == "osm")
    if (auto sound = check_coordinates(bytes); !sound) return sound.error();
  const Names unwanted = format == "osm" ? unwanted_of(bytes) : Names();
  osmium::thread::Pool pool{1};
  osmium::io::File file{bytes.data(), bytes.size(), format};
  osmium::io::Reader reader{file, pool, osmium::osm_entity_bits::nwr};
  while (const osmium::memory::Buffer buffer = reader.read()) {
    take(buffer, unwanted, store);
    const std::size_t count = store.nodes.size() + store.ways.size() + store.relations.size();
    if (!goes_on(watch, "reading elements", count, 0)) return Error{ErrorCode::cancelled, "", "The import was stopped."};
    if (count > kMostOsmElements)
      return Error{ErrorCode::out_of_range, "",
                   "The file holds more than " + std::to_string(kMostOsmElements) +
                       " elements, the most that is read: cut out the part that you need."};
  }
  reader.close();
  store.older_nodes = sort_and_keep_last(store.nodes);
  store.older_ways = sort_and_keep_last(store.ways);
  store.older_relations = sort_and_keep_last(store.relations);
  drop_deleted('n', store.nodes, store);
  drop_deleted('w', store.ways, store);
  drop_deleted('r', store.relations, store);
  return store;
}

Error xml_fault(const osmium::xml_error& error) {
  // The end of the file where more of it was to come.
  const bool is_cut = error.error_code == XML_ERROR_NO_ELEMENTS || error.error_code == XML_ERROR_UNCLOSED_TOKEN ||
                      error.error_code == XML_ERROR_PARTIAL_CHAR || error.error_code == XML_ERROR_UNCLOSED_CDATA_SECTION;
  // Where the reader knows no place (what is no XML error but one of OpenStreetMap's form), it says 0.
  if (error.line == 0 && !is_cut)
    return {ErrorCode::parse, "XML", std::string("This is not what OpenStreetMap files hold: ") + error.what() + "."};
  const std::string place =
      error.line > 0 ? "line " + std::to_string(error.line) + ", column " + std::to_string(error.column) : "XML";
  if (is_cut) return {ErrorCode::parse, place, "The XML ends here: the file is cut off. Fetch or export it again."};
  return {ErrorCode::parse, place, std::string("The XML cannot be read from here on: ") + error.what() + ". It is damaged."};
}

}  // namespace

Result<OsmStore> read_osm(std::string_view bytes, ImportWatch* watch) {
  auto text = unpacked(bytes);
  if (!text) return text.error();
  if (text->empty()) return Error{ErrorCode::missing, "byte 0", "The file is empty: an OpenStreetMap extract is needed."};
  const std::string format = format_of(*text);
  if (format.empty()) {
    if (is_beginning_of_osm(*text))
      return Error{ErrorCode::parse, "byte " + std::to_string(text->size()),
                   "The OpenStreetMap file ends in its first lines: it is cut off. Fetch or export it again."};
    const std::string_view remedy = "it has to be XML that begins with <osm>, or PBF";
    if (auto foreign = foreign_bytes(*text, "OpenStreetMap file", remedy)) return *foreign;
    return Error{ErrorCode::parse, "byte 0", "This is no OpenStreetMap file: neither XML that begins with <osm> nor PBF."};
  }
  if (format == "pbf")
    if (auto whole = check_pbf_blocks(*text); !whole) return whole.error();
  try {
    return read(*text, format, watch);
  } catch (const osmium::xml_error& error) { return xml_fault(error); } catch (const std::bad_alloc&) {
    throw;  // no fault of the file
  } catch (const std::system_error&) { throw; } catch (const std::exception& error) {
    // Of a PBF the library speaks in words of its own format, which help nobody.
    if (format == "pbf")
      return Error{ErrorCode::parse, "PBF", "A block of the PBF cannot be read: the file is damaged or cut off."};
    return Error{ErrorCode::parse, "XML",
                 std::string("The OpenStreetMap file cannot be read to its end: ") + error.what() + ". It is damaged."};
  }
}

}  // namespace bl::importing
