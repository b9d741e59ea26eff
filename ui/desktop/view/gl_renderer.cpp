// One picture: maps of shadow and height where shapes are new, then volumes, ground, surfaces, lines, and the last pass.
#include "ui/desktop/view/gl_renderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/desktop/view/shaders_picture.h"
#include "ui/desktop/view/shaders_scene.h"
#include "ui/desktop/view/shaders_volume.h"

namespace bl::desktop {

namespace {

constexpr int kHurriedTriangles = 30000, kSoftwareTriangles = 110000, kHardwareTriangles = 3000000;
constexpr int kHeightMap = 128, kLargestPicture = 8192;

std::string text_of(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

void set_point(const GlProgram& program, const char* name, const Vector3& p) {
  glUniform3f(program.at(name), static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
}

// Along `towards` from all around the scene, as a box.
Matrix box_matrix(const ViewScene& scene, const Vector3& towards, double reach) {
  Camera camera;
  camera.is_parallel = true;
  camera.target = scene.centre;
  camera.elevation = std::asin(std::clamp(towards.z, -1.0, 1.0));
  camera.azimuth = std::atan2(towards.y, towards.x);
  camera.distance = reach / std::tan(Camera::kFieldOfView / 2);
  return camera.matrix(scene.origin, 1, camera.distance - 1.5 * reach, camera.distance + 1.5 * reach);
}

}  // namespace

GlRenderer::GlRenderer()
    : programs_(std::make_unique<Programs>()),
      picture_({{GL_RGBA8, GL_NEAREST}, {GL_R32UI, GL_NEAREST}}, GL_DEPTH24_STENCIL8),
      final_({{GL_RGBA8, GL_LINEAR}}, 0),
      shadow_({}, GL_DEPTH_COMPONENT24, true),
      heights_({{GL_RG16F, GL_LINEAR}}, 0),
      blurred_({{GL_RG16F, GL_LINEAR}}, 0) {}

GlRenderer::~GlRenderer() {
  glDeleteVertexArrays(1, &empty_);
  glDeleteVertexArrays(1, &surfaces_.array);
  glDeleteVertexArrays(1, &bodies_.array);
  glDeleteVertexArrays(1, &line_array_);
}

std::unique_ptr<GlRenderer> GlRenderer::make(std::string& failure) {
  std::unique_ptr<GlRenderer> renderer(new GlRenderer());
  if (!renderer->build(failure)) return nullptr;
  return renderer;
}

bool GlRenderer::build(std::string& failure) {
  const std::string version = shaders::kVersion, divide = version + shaders::kDivide, light = shaders::kLight;
  Programs& p = *programs_;
  struct Recipe {
    GlProgram* program;
    std::string vertex, fragment;
    std::vector<const char*> captured;
  };
  const std::string nothing = version + "void main() {}\n";
  const Recipe recipes[] = {
      {&p.volumes, divide + shaders::kVolumeVertex, version + light + shaders::kFacade + shaders::kVolumeFragment, {}},
      {&p.cut_volumes,
       divide + shaders::kVolumeVertex,
       version + "#define WITH_SECTION\n" + light + shaders::kFacade + shaders::kVolumeFragment,
       {}},
      {&p.shadow, divide + shaders::kShadowVertex, version + shaders::kShadowFragment, {}},
      {&p.heights, divide + shaders::kShadowVertex, version + shaders::kHeightFragment, {}},
      {&p.capture, divide + shaders::kCaptureVertex, nothing, {"captured"}},
      {&p.ground, version + shaders::kGroundVertex, version + light + shaders::kGroundFragment, {}},
      {&p.surfaces, version + shaders::kSurfaceVertex, version + shaders::kSurfaceFragment, {}},
      {&p.lines, version + shaders::kLineVertex, version + shaders::kLineFragment, {}},
      {&p.pictures, version + shaders::kPictureVertex, version + shaders::kPictureFragment, {}},
      {&p.blur, version + shaders::kWholeVertex, version + shaders::kBlurFragment, {}},
      {&p.finish, version + shaders::kWholeVertex, version + shaders::kFinishFragment, {}}};
  for (const Recipe& recipe : recipes)
    if (!recipe.program->build(recipe.vertex, recipe.fragment, recipe.captured)) {
      failure = "the graphics driver refuses a shader: " + recipe.program->failure();
      return false;
    }
  glGenVertexArrays(1, &empty_);
  glGenVertexArrays(1, &surfaces_.array);
  glGenVertexArrays(1, &bodies_.array);
  glGenVertexArrays(1, &line_array_);
  description_ = text_of(GL_RENDERER) + ", OpenGL " + text_of(GL_VERSION);
  is_software_ = description_.find("llvmpipe") != std::string::npos || description_.find("softpipe") != std::string::npos ||
                 description_.find("SwiftShader") != std::string::npos;
  // What is drawn at twice the size and shown at half of it has smooth edges; in software that would cost too much.
  oversampling_ = is_software_ ? 1 : 2;
  return true;
}

int GlRenderer::affordable(const ViewScene& scene, int less) const {
  const int usual = !is_software_ ? kHardwareTriangles : scene.is_hurried ? kHurriedTriangles : kSoftwareTriangles;
  const int most = scene.most_triangles > 0 ? scene.most_triangles : usual;
  return std::max(0, depth_within(coarse_triangles(scene.volumes), most, is_software_ ? 3 : GlVolumes::kDeepest) - less);
}

bool GlRenderer::has_new_shapes(const ViewScene& scene) const {
  return !has_last_ || scene.section != last_.section || scene.centre != last_.centre || scene.radius != last_.radius ||
         scene.origin != last_.origin || scene.sun != last_.sun || scene.ground != last_.ground ||
         scene.layers.shadows != last_.layers.shadows || !have_same_cells(scene.volumes, last_.volumes);
}

std::uintptr_t GlRenderer::draw(const ViewScene& scene, int width, int height) {
  if (width <= 0 || height <= 0) return 0;
  int factor = oversampling_;
  while (factor > 1 && std::max(width, height) * factor > kLargestPicture) --factor;
  const int w = std::min(width * factor, kLargestPicture), h = std::min(height * factor, kLargestPicture);
  const bool has_news = pictures_.has_news();
  if (!has_news && has_last_ && w == final_.width() && h == final_.height() && scene == last_) return final_.plane(0);
  if (!picture_.resize(w, h) || !final_.resize(w, h)) return 0;
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  pixel_ = scene.scale * static_cast<float>(factor);
  depth_ = affordable(scene, 0);
  volumes_.update(scene, depth_, traffic_);
  if (scene.layers.shadows && has_new_shapes(scene)) draw_maps(scene);
  matrix_ = scene.camera.matrix(scene.origin, static_cast<double>(w) / h, scene.near_plane(), scene.far_plane());
  picture_.bind();
  const GLuint nobody[4] = {0, 0, 0, 0};
  const auto channel = [&](int shift) { return static_cast<float>((scene.colours.sky >> shift) & 0xff) / 255.0f; };
  const float sky[4] = {channel(0), channel(8), channel(16), 1};
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glClearBufferfv(GL_COLOR, 0, sky);
  glClearBufferuiv(GL_COLOR, 1, nobody);
  glClearBufferfi(GL_DEPTH_STENCIL, 0, 1, 0);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  draw_volumes(scene);
  draw_ground(scene);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  glColorMaski(1, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw_pictures(scene);
  draw_surfaces(scene);
  draw_lines(scene);
  draw_bodies(scene);
  glColorMaski(1, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  finish(scene);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glActiveTexture(GL_TEXTURE0);
  last_ = scene;
  has_last_ = true;
  return final_.plane(0);
}

// Where the sun reaches, and what stands how high: both are drawn coarser than the picture, because both are soft.
void GlRenderer::draw_maps(const ViewScene& scene) {
  const int size = is_software_ ? 1024 : 2048, depth = std::clamp(depth_ - 1, 0, 2);
  if (!shadow_.resize(size, size) || !heights_.resize(kHeightMap, kHeightMap) || !blurred_.resize(kHeightMap, kHeightMap)) return;
  sun_matrix_ = box_matrix(scene, scene.sun, scene.radius);
  map_matrix_ = box_matrix(scene, {0, 0, 1}, 1.3 * scene.radius);
  shadow_.bind();
  const float far = 1, none[4] = {0, 0, 0, 0};
  glDepthMask(GL_TRUE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glClearBufferfv(GL_DEPTH, 0, &far);
  programs_->shadow.use();
  programs_->shadow.set_matrix("matrix", sun_matrix_.data());
  programs_->shadow.set("section", section_of(scene));
  volumes_.draw(programs_->shadow, depth);
  glDisable(GL_DEPTH_TEST);
  heights_.bind();
  glClearBufferfv(GL_COLOR, 0, none);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  glBlendEquation(GL_MAX);
  programs_->heights.use();
  programs_->heights.set_matrix("matrix", map_matrix_.data());
  programs_->heights.set("heights", static_cast<float>(scene.ground - scene.origin.z), static_cast<float>(0.5 * scene.radius));
  programs_->heights.set("section", section_of(scene));
  volumes_.draw(programs_->heights, depth);
  glDisable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  programs_->blur.use();
  programs_->blur.set("picture", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindVertexArray(empty_);
  for (int pass = 0; pass < 2; ++pass) {
    (pass == 0 ? blurred_ : heights_).bind();
    glBindTexture(GL_TEXTURE_2D, (pass == 0 ? heights_ : blurred_).plane(0));
    programs_->blur.set("way", pass == 0 ? 1.0f / kHeightMap : 0.0f, pass == 0 ? 0.0f : 1.0f / kHeightMap);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }
  glBindVertexArray(0);
}

void GlRenderer::set_light(const GlProgram& program, const ViewScene& scene) const {
  set_point(program, "sun", scene.sun);
  program.set_matrix("sun_matrix", sun_matrix_.data());
  program.set_matrix("map_matrix", map_matrix_.data());
  program.set("shadow_map", 2);
  program.set("height_map", 3);
  program.set("heights", static_cast<float>(scene.ground - scene.origin.z), static_cast<float>(0.5 * scene.radius));
  const bool has_maps = scene.layers.shadows && shadow_.width() > 0 && blurred_.width() > 0 && heights_.width() > 0;
  program.set("shadow_strength", has_maps ? 0.85f : 0.0f);
  program.set("shadow_texel", 1.0f / static_cast<float>(std::max(1, shadow_.width())));
  program.set("light_gain", scene.colours.is_dark ? 0.92f : 1.0f);
  glActiveTexture(GL_TEXTURE2);
  glBindTexture(GL_TEXTURE_2D, shadow_.depth());
  glActiveTexture(GL_TEXTURE3);
  glBindTexture(GL_TEXTURE_2D, has_maps ? heights_.plane(0) : 0);
}

std::array<float, 4> GlRenderer::section_of(const ViewScene& scene) {
  if (!scene.section.is_on) return {0, 0, 0, 1};
  const Vector3& n = scene.section.normal;
  return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z),
          static_cast<float>(scene.section.offset - dot(n, scene.origin))};
}

void GlRenderer::draw_volumes(const ViewScene& scene) {
  const GlProgram& program = scene.section.is_on ? programs_->cut_volumes : programs_->volumes;
  const ViewColours& c = scene.colours;
  program.use();
  program.set_matrix("matrix", matrix_.data());
  set_light(program, scene);
  program.set_colour("edge_colour", c.edge);
  program.set_colour("chosen_colour", c.chosen);
  program.set_colour("hovered_colour", c.hovered);
  program.set_colour("cut_colour", c.cut);
  program.set_colour("ground_colour", c.ground);
  program.set("section", section_of(scene));
  set_point(program, "eye", scene.camera.eye() - scene.origin);
  set_point(program, "looking", scene.camera.forward());
  program.set("is_parallel", scene.camera.is_parallel ? 1.0f : 0.0f);
  if (scene.section.is_on) {
    // Strokes some nine pixels apart, in steps of two so that they stand still while the camera moves a little.
    const double pixel_size = scene.camera.metres_per_pixel(scene.camera.target, picture_.height());
    program.set("hatch", static_cast<float>(std::exp2(std::round(std::log2(std::max(1e-6, 9 * pixel_ * pixel_size))))));
  }
  program.set("pixel", pixel_);
  program.set("half_height", 0.5f * static_cast<float>(picture_.height()));
  program.set("with_edges", scene.layers.edges ? 1.0f : 0.0f);
  program.set("with_storeys", scene.layers.storeys ? 1.0f : 0.0f);
  volumes_.draw(program, depth_);
}

void GlRenderer::draw_pictures(const ViewScene& scene) {
  if (scene.pictures.empty()) return;
  const GlProgram& program = programs_->pictures;
  program.use();
  program.set_matrix("matrix", matrix_.data());
  program.set("section", section_of(scene));
  program.set_colour("frame_colour", scene.colours.edge);
  program.set_colour("ground_colour", scene.colours.ground);
  pictures_.draw(scene, program, empty_, traffic_);
}

void GlRenderer::draw_ground(const ViewScene& scene) {
  // From below the ground it would hide everything.
  const Vector3 forward = scene.camera.forward();
  const bool is_from_below = scene.camera.is_parallel ? forward.z > -1e-3 : scene.camera.eye().z <= scene.ground;
  if (is_from_below || !scene.layers.ground) return;
  const GlProgram& program = programs_->ground;
  const Vector3 centre = scene.centre - scene.origin;
  program.use();
  program.set_matrix("matrix", matrix_.data());
  set_light(program, scene);
  program.set("plot", static_cast<float>(centre.x), static_cast<float>(centre.y), static_cast<float>(5 * scene.radius), 0);
  program.set("level", static_cast<float>(scene.ground - scene.origin.z));
  program.set("section", scene.is_ground_cut ? section_of(scene) : std::array<float, 4>{0, 0, 0, 1});
  program.set("grid", static_cast<float>(scene.grid));
  program.set("grid_origin", static_cast<float>(-std::fmod(scene.origin.x, 10 * scene.grid)),
              static_cast<float>(-std::fmod(scene.origin.y, 10 * scene.grid)));
  program.set_colour("ground_colour", scene.colours.ground);
  program.set_colour("sky_colour", scene.colours.sky);
  program.set_colour("grid_colour", scene.colours.grid);
  glBindVertexArray(empty_);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glBindVertexArray(0);
}

void GlRenderer::finish(const ViewScene& scene) {
  final_.bind();
  const GlProgram& program = programs_->finish;
  program.use();
  program.set("picture", 0);
  program.set("labels", 1);
  program.set_colour("edge_colour", scene.colours.edge);
  program.set_colour("chosen_colour", scene.colours.chosen);
  program.set_colour("hovered_colour", scene.colours.hovered);
  program.set("with_edges", scene.layers.edges ? 1.0f : 0.0f);
  program.set("reach", static_cast<int>(std::lround(2 * pixel_)));
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, picture_.plane(1));
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, picture_.plane(0));
  glBindVertexArray(empty_);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glBindVertexArray(0);
}

std::vector<float> GlRenderer::divided(const ViewScene& scene, int depth) {
  volumes_.update(scene, depth, traffic_);
  const std::size_t floats = 9 * (volumes_.coarse_triangles() << (2 * static_cast<unsigned>(depth)));
  if (floats == 0) return {};
  // Without a window there is no target to draw to, and nothing would be drawn.
  if (final_.width() == 0 && !final_.resize(16, 16)) return {};
  final_.bind();
  GlBuffer target;
  target.reserve(floats * sizeof(float), GL_STREAM_READ);
  programs_->capture.use();
  glEnable(GL_RASTERIZER_DISCARD);
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, target.id());
  glBeginTransformFeedback(GL_TRIANGLES);
  volumes_.draw(programs_->capture, depth);
  glEndTransformFeedback();
  glDisable(GL_RASTERIZER_DISCARD);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  std::vector<float> out(floats);
  glBindBuffer(GL_ARRAY_BUFFER, target.id());
  glGetBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(floats * sizeof(float)), out.data());
  return out;
}

std::vector<std::uint8_t> GlRenderer::pixels() const {
  std::vector<std::uint8_t> out(4 * static_cast<std::size_t>(final_.width()) * static_cast<std::size_t>(final_.height()));
  if (out.empty()) return out;
  final_.bind();
  glReadPixels(0, 0, final_.width(), final_.height(), GL_RGBA, GL_UNSIGNED_BYTE, out.data());
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  return out;
}

std::uint64_t GlRenderer::take_bytes_sent() { return std::exchange(traffic_.sent, 0); }
std::uint64_t GlRenderer::take_bytes_spared() { return std::exchange(traffic_.spared, 0); }

}  // namespace bl::desktop
