// What draws the 3D view, behind an interface: OpenGL in the window, nothing at all in tests of panels.
#pragma once

#include <cstdint>
#include <string>

namespace bl::desktop {

struct ViewScene;

class Renderer {
 public:
  virtual ~Renderer() = default;
  /// Draws into a picture of that size [pixels] and returns it as ImGui's texture; 0: there is nothing to show.
  virtual std::uintptr_t draw(const ViewScene& scene, int width, int height) = 0;
  /// Bytes that were sent to the graphics processor since the last call.
  virtual std::uint64_t take_bytes_sent() = 0;
  /// Name of the driver, for the statistics.
  virtual std::string description() const = 0;
};

/// Draws nothing and counts what it would have been sent.
class NullRenderer final : public Renderer {
 public:
  std::uintptr_t draw(const ViewScene&, int, int) override { return 0; }
  std::uint64_t take_bytes_sent() override { return 0; }
  std::string description() const override { return "no renderer"; }
};

}  // namespace bl::desktop
