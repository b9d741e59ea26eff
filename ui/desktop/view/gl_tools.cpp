// OpenGL objects made, resized and let go.
#include "ui/desktop/view/gl_tools.h"

#include <algorithm>

namespace bl::desktop {

namespace {

GLuint compile(GLenum kind, const std::string& source, std::string& failure) {
  const GLuint shader = glCreateShader(kind);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint is_good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &is_good);
  if (is_good != 0) return shader;
  char log[2000] = {};
  glGetShaderInfoLog(shader, sizeof log, nullptr, log);
  failure = log;
  glDeleteShader(shader);
  return 0;
}

}  // namespace

GlProgram::~GlProgram() {
  if (id_ != 0) glDeleteProgram(id_);
}

bool GlProgram::build(const std::string& vertex, const std::string& fragment, const std::vector<const char*>& captured) {
  const GLuint first = compile(GL_VERTEX_SHADER, vertex, failure_);
  if (first == 0) return false;
  const GLuint second = fragment.empty() ? 0 : compile(GL_FRAGMENT_SHADER, fragment, failure_);
  if (second == 0 && !fragment.empty()) {
    glDeleteShader(first);
    return false;
  }
  id_ = glCreateProgram();
  glAttachShader(id_, first);
  if (second != 0) glAttachShader(id_, second);
  if (!captured.empty())
    glTransformFeedbackVaryings(id_, static_cast<GLsizei>(captured.size()), captured.data(), GL_INTERLEAVED_ATTRIBS);
  glLinkProgram(id_);
  glDeleteShader(first);
  if (second != 0) glDeleteShader(second);
  GLint is_good = 0;
  glGetProgramiv(id_, GL_LINK_STATUS, &is_good);
  if (is_good != 0) return true;
  char log[2000] = {};
  glGetProgramInfoLog(id_, sizeof log, nullptr, log);
  failure_ = log;
  glDeleteProgram(id_);
  id_ = 0;
  return false;
}

void GlProgram::set_colour(const char* uniform, std::uint32_t packed) const {
  const auto channel = [&](int shift) { return static_cast<float>((packed >> shift) & 0xff) / 255.0f; };
  glUniform4f(at(uniform), channel(0), channel(8), channel(16), channel(24));
}

GlBuffer::~GlBuffer() {
  if (id_ != 0) glDeleteBuffers(1, &id_);
}

bool GlBuffer::reserve(std::size_t bytes, GLenum usage) {
  if (id_ != 0 && bytes <= size_) return false;
  if (id_ == 0) glGenBuffers(1, &id_);
  size_ = std::max<std::size_t>({bytes, 2 * size_, 1024});
  glBindBuffer(GL_ARRAY_BUFFER, id_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(size_), nullptr, usage);
  return true;
}

void GlBuffer::write(std::size_t offset, const void* data, std::size_t bytes, Traffic& traffic) {
  if (bytes == 0 || offset + bytes > size_) return;
  glBindBuffer(GL_ARRAY_BUFFER, id_);
  glBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
  traffic.sent += bytes;
}

GlTexels::~GlTexels() {
  if (texture_ != 0) glDeleteTextures(1, &texture_);
}

bool GlTexels::reserve(std::size_t bytes) {
  const bool is_new = buffer.reserve(bytes);
  if (texture_ == 0) glGenTextures(1, &texture_);
  if (is_new) {
    glBindTexture(GL_TEXTURE_BUFFER, texture_);
    glTexBuffer(GL_TEXTURE_BUFFER, format_, buffer.id());
  }
  return is_new;
}

void GlTexels::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_BUFFER, texture_);
}

GlTarget::GlTarget(std::vector<Plane> planes, GLint depth, bool compares)
    : planes_(std::move(planes)), depth_format_(depth), compares_(compares) {}

GlTarget::~GlTarget() { clear(); }

void GlTarget::clear() {
  if (!textures_.empty()) glDeleteTextures(static_cast<GLsizei>(textures_.size()), textures_.data());
  if (depth_ != 0) glDeleteTextures(1, &depth_);
  if (frame_ != 0) glDeleteFramebuffers(1, &frame_);
  textures_.clear();
  frame_ = depth_ = 0;
  width_ = height_ = 0;
}

bool GlTarget::resize(int width, int height) {
  if (frame_ != 0 && width == width_ && height == height_) return true;
  clear();
  width_ = width;
  height_ = height;
  glGenFramebuffers(1, &frame_);
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  const auto texture = [&](GLint format, GLenum layout, GLenum kind, GLint filter, GLenum attachment) {
    GLuint id = 0;
    glGenTextures(1, &id);
    glBindTexture(GL_TEXTURE_2D, id);
    glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, layout, kind, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, id, 0);
    return id;
  };
  std::vector<GLenum> drawn;
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    const bool is_integer = planes_[k].format == GL_R32UI;
    const GLenum attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(k);
    textures_.push_back(texture(planes_[k].format, is_integer ? GL_RED_INTEGER : GL_RGBA,
                                is_integer ? GL_UNSIGNED_INT : GL_UNSIGNED_BYTE, planes_[k].filter, attachment));
    drawn.push_back(attachment);
  }
  if (drawn.empty()) drawn.push_back(GL_NONE);
  glDrawBuffers(static_cast<GLsizei>(drawn.size()), drawn.data());
  if (depth_format_ != 0) {
    const bool has_stencil = depth_format_ == GL_DEPTH24_STENCIL8;
    depth_ = texture(depth_format_, has_stencil ? GL_DEPTH_STENCIL : GL_DEPTH_COMPONENT,
                     has_stencil ? GL_UNSIGNED_INT_24_8 : GL_FLOAT, compares_ ? GL_LINEAR : GL_NEAREST,
                     has_stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT);
    if (compares_) {
      glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
      glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    }
  }
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return true;
  // Nothing is left that looks as if one could draw into it.
  clear();
  return false;
}

void GlTarget::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  glViewport(0, 0, width_, height_);
}

}  // namespace bl::desktop
