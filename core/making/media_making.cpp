// The node of a picture: its facts become set ports, its place follows from its coordinates.
#include "core/making/media_making.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include <nlohmann/json.hpp>

#include "core/base/mathematics.h"
#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/file/file_io.h"
#include "core/import/image_facts.h"
#include "core/session/commands.h"

namespace bl::making {

namespace {

constexpr double kEyeHeight = 1.6, kDegree = std::numbers::pi / 180;
// WGS84: half the long axis [m], and the square of the eccentricity.
constexpr double kHalfAxis = 6378137, kEccentricity = 0.00669437999014;
// Farther away than this from the scene a picture is not placed by its coordinates [m].
constexpr double kFarthest = 20000;

std::string relative_to_scene(const std::string& file, const std::string& scene) {
  std::error_code error;
  const auto path = std::filesystem::absolute(file, error).lexically_normal();
  if (error || scene.empty()) return path.string();
  const auto folder = std::filesystem::absolute(scene, error).lexically_normal().parent_path();
  const auto near = path.lexically_relative(folder);
  return error || near.empty() ? path.string() : near.generic_string();
}

// East and north of the scene's origin on the ellipsoid, turned into the scene. Good to a decimetre within some kilometres, far
// finer than what cameras know of their place.
Vector3 local_place(double latitude, double longitude, const Settings& settings) {
  const double s = mathematics::sine(settings.latitude * kDegree), w = 1 - kEccentricity * s * s;
  const double north = (latitude - settings.latitude) * kDegree * kHalfAxis * (1 - kEccentricity) / (w * std::sqrt(w));
  const double east =
      (longitude - settings.longitude) * kDegree * kHalfAxis / std::sqrt(w) * mathematics::cosine(settings.latitude * kDegree);
  const double turn = settings.true_north * kDegree;
  return {east * mathematics::cosine(turn) + north * mathematics::sine(turn),
          north * mathematics::cosine(turn) - east * mathematics::sine(turn), 0};
}

// How high the scene's zero lies above the sea [m]: heights of terrains count from the sea, and a sun knows the height of its
// site. Nothing where the scene does not say.
std::optional<double> height_of_zero(const Scene& scene) {
  std::optional<double> height;
  for (const auto& [id, node] : scene.nodes) {
    if (node.types.contains("terrain")) return 0;
    const auto sun = node.types.find("sun_and_sky");
    if (sun == node.types.end() || height) continue;
    if (const auto set = sun->second.find("elevation"); set != sun->second.end()) height = as_number(set->second);
  }
  return height;
}

// The height of the camera in the scene [m]: as its GPS says where the scene tells how high it lies itself, else of people's
// eyes.
double height_of(const importing::ImageFacts& facts, const Scene& scene, std::vector<std::string>& notes) {
  if (!facts.altitude) return kEyeHeight;
  const std::string told = "the picture was taken " + fixed(*facts.altitude, 1) + " m above the sea";
  const auto zero = height_of_zero(scene);
  if (!zero) {
    notes.push_back(told +
                    ", but the scene does not say how high it lies (by a terrain, or the `elevation` of its sun): it stands "
                    "at the height of people's eyes");
    return kEyeHeight;
  }
  notes.push_back(told + " and stands there: such heights can be wrong by ten metres and more");
  return *facts.altitude - *zero;
}

Vector3 position_of(const importing::ImageFacts& facts, const Scene& scene, std::vector<std::string>& notes) {
  const Settings settings = settings_of(scene);
  if (!facts.latitude) {
    notes.emplace_back("the picture does not say where it was taken: it stands at the origin, move it to its place");
    return {0, 0, kEyeHeight};
  }
  if (settings.latitude == 0 && settings.longitude == 0) {
    notes.emplace_back(
        "the scene does not say where on Earth it lies (`latitude`, `longitude`): the picture stands at the origin");
    return {0, 0, kEyeHeight};
  }
  const Vector3 place = local_place(*facts.latitude, *facts.longitude, settings);
  if (!(norm(place) < kFarthest)) {
    notes.push_back("the picture was taken " + fixed(norm(place) / 1000, 0) + " km away from the scene: it stands at the origin");
    return {0, 0, kEyeHeight};
  }
  return place + Vector3{0, 0, height_of(facts, scene, notes)};
}

// What is proposed is said, because it decides what may be done with the picture.
void tell_of_rights(const importing::ImageFacts& facts, const MediaOptions& options, std::vector<std::string>& notes) {
  std::string said;
  const auto tell = [&said](const char* what, const std::string& text, const std::string& given) {
    if (!text.empty() && given.empty()) said += (said.empty() ? "its " : ", its ") + std::string(what) + " is `" + text + "`";
  };
  tell("author", facts.author, options.author);
  tell("licence", facts.licence, options.licence);
  if (!said.empty()) notes.push_back(said + ", as the file says: check it");
}

std::string fresh_id(const std::string& file, const Scene& scene) {
  const std::string wish = to_identifier(std::filesystem::path(file).stem().string()).substr(0, 56);
  std::string id = wish;
  for (int k = 2; scene.nodes.contains(id) || scene.links.contains(id); ++k) id = wish + "-" + std::to_string(k);
  return id;
}

}  // namespace

bool is_picture_name(const std::string& file) {
  std::string end = std::filesystem::path(file).extension().string();
  std::transform(end.begin(), end.end(), end.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return end == ".jpg" || end == ".jpeg" || end == ".png";
}

Result<MadeMedia> make_media(const std::string& file, const Scene& scene, const MediaOptions& options) {
  const auto bytes = read_file(file);
  if (!bytes) return bytes.error();
  const auto facts = importing::read_image_facts(*bytes);
  if (!facts) return facts.error();
  const Settings settings = settings_of(scene);
  MadeMedia made{fresh_id(file, scene), {}, facts->notes};
  const Vector3 at = options.position ? *options.position : position_of(*facts, scene, made.notes);
  const std::string placement = !options.placement.empty() ? options.placement : facts->bearing ? "camera" : "billboard";
  Json media{{"file", relative_to_scene(file, options.scene)},
             {"placement", placement},
             {"consent", options.consent},
             {"licence", options.licence.empty() ? facts->licence : options.licence},
             {"author", options.author.empty() ? facts->author : options.author},
             {"note", facts->note},
             {"pixel_width", facts->width},
             {"pixel_height", facts->height},
             {"orientation", facts->orientation},
             {"taken", facts->taken}};
  if (facts->latitude) {
    media["latitude"] = *facts->latitude;
    media["longitude"] = *facts->longitude;
  }
  if (facts->bearing) media["azimuth"] = std::fmod(*facts->bearing + settings.true_north + 360, 360);
  if (facts->field_of_view) media["field_of_view"] = std::clamp(*facts->field_of_view, 1.0, 170.0);
  if (options.size > 0) media["size"] = options.size;
  tell_of_rights(*facts, options, made.notes);
  if (options.consent == "unknown")
    made.notes.emplace_back("nobody has said that the picture may be shown: it is veiled until `consent` is set");
  const Json node{{"name", std::filesystem::path(file).stem().string()},
                  {"position", {at.x, at.y, at.z}},
                  {"types", {{"media", std::move(media)}}}};
  made.command = command<AddNode>({made.id, JsonValue::of(node)});
  return made;
}

}  // namespace bl::making
