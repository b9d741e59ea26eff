// Small owners of OpenGL objects: programs, buffers, targets; everything that is sent is counted here.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <epoxy/gl.h>

namespace bl::desktop {

/// Bytes that went to the graphics processor.
struct Traffic {
  std::uint64_t sent = 0, spared = 0;
};

/// A linked program; id 0 and a sentence where the driver refuses it.
class GlProgram {
 public:
  GlProgram() = default;
  ~GlProgram();
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;

  /// `captured`: outputs of the vertex shader that are written back instead of drawn. False: `failure` says why.
  bool build(const std::string& vertex, const std::string& fragment, const std::vector<const char*>& captured = {});
  void use() const { glUseProgram(id_); }
  GLint at(const char* uniform) const { return glGetUniformLocation(id_, uniform); }
  void set(const char* uniform, float value) const { glUniform1f(at(uniform), value); }
  void set(const char* uniform, int value) const { glUniform1i(at(uniform), value); }
  void set(const char* uniform, float x, float y) const { glUniform2f(at(uniform), x, y); }
  void set(const char* uniform, float x, float y, float z, float w) const { glUniform4f(at(uniform), x, y, z, w); }
  void set(const char* uniform, const std::array<float, 4>& v) const { glUniform4f(at(uniform), v[0], v[1], v[2], v[3]); }
  /// A packed colour as four floats.
  void set_colour(const char* uniform, std::uint32_t packed) const;
  void set_matrix(const char* uniform, const float* matrix) const { glUniformMatrix4fv(at(uniform), 1, GL_FALSE, matrix); }
  const std::string& failure() const { return failure_; }

 private:
  GLuint id_ = 0;
  std::string failure_;
};

/// A buffer that grows by doubling and remembers nothing but its size.
class GlBuffer {
 public:
  GlBuffer() = default;
  ~GlBuffer();
  GlBuffer(const GlBuffer&) = delete;
  GlBuffer& operator=(const GlBuffer&) = delete;

  /// Room for so many bytes; true where the content is lost by that.
  bool reserve(std::size_t bytes, GLenum usage = GL_DYNAMIC_DRAW);
  void write(std::size_t offset, const void* data, std::size_t bytes, Traffic& traffic);
  GLuint id() const { return id_; }

 private:
  GLuint id_ = 0;
  std::size_t size_ = 0;
};

/// A buffer that shaders read by index, as texels.
class GlTexels {
 public:
  explicit GlTexels(GLenum format) : format_(format) {}
  ~GlTexels();
  GlTexels(const GlTexels&) = delete;
  GlTexels& operator=(const GlTexels&) = delete;

  bool reserve(std::size_t bytes);
  void write(std::size_t offset, const void* data, std::size_t bytes, Traffic& traffic) {
    buffer.write(offset, data, bytes, traffic);
  }
  void bind(int unit) const;

  GlBuffer buffer;

 private:
  GLenum format_;
  GLuint texture_ = 0;
};

/// A picture to draw into: colour attachments and depth, remade when its size changes.
class GlTarget {
 public:
  struct Plane {
    GLint format = GL_RGBA8;
    GLint filter = GL_NEAREST;
  };
  /// `depth`: 0 for none, or a depth format; `compares`: the depth is sampled as a shadow.
  GlTarget(std::vector<Plane> planes, GLint depth, bool compares = false);
  ~GlTarget();
  GlTarget(const GlTarget&) = delete;
  GlTarget& operator=(const GlTarget&) = delete;

  /// False where the driver cannot make it.
  bool resize(int width, int height);
  void bind() const;
  GLuint plane(std::size_t k) const { return textures_[k]; }
  GLuint depth() const { return depth_; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  void clear();

  std::vector<Plane> planes_;
  GLint depth_format_;
  bool compares_;
  std::vector<GLuint> textures_;
  GLuint frame_ = 0, depth_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace bl::desktop
