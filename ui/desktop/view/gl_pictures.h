// Pictures in the scene on the graphics processor: a texture for each file, drawn as a quad, veiled where it may not be shown.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "ui/desktop/view/gl_tools.h"
#include "ui/desktop/view/picture_store.h"
#include "ui/desktop/view/view_scene.h"

namespace bl::desktop {

class GlPictures {
 public:
  GlPictures() = default;
  ~GlPictures();
  GlPictures(const GlPictures&) = delete;
  GlPictures& operator=(const GlPictures&) = delete;

  /// A file has come in: a picture that was drawn before is out of date.
  bool has_news() { return store_.has_news(); }
  bool is_waiting() const { return store_.is_waiting(); }
  /// Until all files have come in that were asked for. For stills and tests.
  void wait() { store_.wait(); }
  /// A sentence where a file that was asked for could not be shown.
  std::string why_missing(const std::string& path) const;
  /// Far ones first. The program is in use, and its section and matrix are set.
  void draw(const ViewScene& scene, const GlProgram& program, GLuint empty_array, Traffic& traffic);

 private:
  struct Texture {
    std::shared_ptr<const DecodedPicture> content;
    GLuint id = 0;
  };
  const Texture& texture_of(const std::string& path, Traffic& traffic);
  void forget_others(const ViewScene& scene);

  PictureStore store_;
  std::map<std::string, Texture> textures_;
};

}  // namespace bl::desktop
