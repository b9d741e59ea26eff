// Textures with mipmaps: a veil is a picture that is looked at through its coarsest levels.
#include "ui/desktop/view/gl_pictures.h"

#include <algorithm>
#include <vector>

namespace bl::desktop {

GlPictures::~GlPictures() {
  for (const auto& [path, texture] : textures_)
    if (texture.id != 0) glDeleteTextures(1, &texture.id);
}

const GlPictures::Texture& GlPictures::texture_of(const std::string& path, Traffic& traffic) {
  Texture& texture = textures_[path];
  const auto content = store_.find(path);
  if (texture.content == content) return texture;
  texture.content = content;
  if (content->standing != DecodedPicture::Standing::ready) return texture;
  if (texture.id == 0) glGenTextures(1, &texture.id);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture.id);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, content->width, content->height, 0, GL_RGBA, GL_UNSIGNED_BYTE, content->pixels.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  traffic.sent += content->pixels.size();
  return texture;
}

std::string GlPictures::why_missing(const std::string& path) const {
  const auto found = textures_.find(path);
  const bool has_failed =
      found != textures_.end() && found->second.content && found->second.content->standing == DecodedPicture::Standing::failed;
  return has_failed ? found->second.content->reason : "";
}

// A sequence would fill the memory with the frames that it has left behind.
void GlPictures::forget_others(const ViewScene& scene) {
  constexpr std::size_t kMost = 64;
  if (textures_.size() <= kMost) return;
  std::vector<std::string> kept;
  for (const ViewPicture& picture : scene.pictures) kept.push_back(picture.path);
  std::erase_if(textures_, [&](auto& entry) {
    if (std::find(kept.begin(), kept.end(), entry.first) != kept.end()) return false;
    if (entry.second.id != 0) glDeleteTextures(1, &entry.second.id);
    return true;
  });
  store_.keep_only(kept);
}

void GlPictures::draw(const ViewScene& scene, const GlProgram& program, GLuint empty_array, Traffic& traffic) {
  if (scene.pictures.empty()) return;
  forget_others(scene);
  std::vector<const ViewPicture*> order;
  for (const ViewPicture& picture : scene.pictures) order.push_back(&picture);
  const Point3 eye = scene.camera.eye();
  std::stable_sort(order.begin(), order.end(), [&](const ViewPicture* a, const ViewPicture* b) {
    return squared_norm(a->middle() - eye) > squared_norm(b->middle() - eye);
  });
  glBindVertexArray(empty_array);
  for (const ViewPicture* picture : order) {
    const Texture& texture = texture_of(picture->path, traffic);
    const bool is_ready = texture.content->standing == DecodedPicture::Standing::ready;
    const auto set_corner = [&](const char* name, const Point3& p) {
      const Vector3 at = p - scene.origin;
      glUniform3f(program.at(name), static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z));
    };
    set_corner("lower_left", picture->corner);
    set_corner("to_right", picture->across + scene.origin);
    set_corner("to_top", picture->up + scene.origin);
    program.set("opacity", picture->opacity);
    program.set("aspect", static_cast<float>(norm(picture->across) / std::max(1e-9, norm(picture->up))));
    program.set("orientation", picture->orientation);
    program.set("standing", !is_ready ? 2 : picture->is_veiled ? 1 : 0);
    program.set("picture", 0);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, is_ready ? texture.id : 0);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }
  glBindVertexArray(0);
}

}  // namespace bl::desktop
