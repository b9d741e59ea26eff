// What draws the 3D view, behind an interface: OpenGL in the window, nothing at all in tests of panels.
#pragma once

#include <cstdint>
#include <string>

#include "ui/desktop/view/view_scene.h"

namespace bl::desktop {

class Renderer {
 public:
  virtual ~Renderer() = default;
  /// Draws into a picture of that size [pixels] and returns it as ImGui's texture; 0: there is nothing to show.
  virtual std::uintptr_t draw(const ViewScene& scene, int width, int height) = 0;
  /// Bytes that were sent to the graphics processor since the last call.
  virtual std::uint64_t take_bytes_sent() = 0;
  /// Bytes that the meshes of the same volumes would have taken, had they been divided and wrapped before; since the last call.
  virtual std::uint64_t take_bytes_spared() { return 0; }
  /// Why the picture of a file cannot be shown, a sentence; empty while it is waited for and where all is well.
  virtual std::string why_missing(const std::string& path) {
    (void)path;
    return "";
  }
  /// Are files of pictures still to come in, so that the next picture will be another one?
  virtual bool is_waiting() const { return false; }
  /// Name of the driver, for the statistics.
  virtual std::string description() const = 0;
};

/// Draws nothing, and keeps what it was given to draw.
class NullRenderer final : public Renderer {
 public:
  std::uintptr_t draw(const ViewScene& scene, int width, int height) override {
    last_ = scene;
    width_ = width;
    height_ = height;
    ++count_;
    return 0;
  }
  std::uint64_t take_bytes_sent() override { return 0; }
  std::string description() const override { return "no renderer"; }

  /// For tests: the last picture that was asked for, its size, and how many there were.
  const ViewScene& last() const { return last_; }
  int width() const { return width_; }
  int height() const { return height_; }
  int count() const { return count_; }

 private:
  ViewScene last_;
  int width_ = 0, height_ = 0, count_ = 0;
};

}  // namespace bl::desktop
