// EGL on Mesa's surfaceless platform: the same driver as under Xvfb, without a server.
#include "tests/ui/desktop/offscreen_gl.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#include <sanitizer/lsan_interface.h>
#define BL_LEAKS_ARE_WATCHED
#endif
#endif

namespace bl::desktop {

namespace {

// The driver keeps some blocks for ever and is unloaded before they are looked for: while it is in use, nothing is watched.
void watch_leaks([[maybe_unused]] bool is_on) {
#ifdef BL_LEAKS_ARE_WATCHED
  if (is_on) __lsan_enable();
  else __lsan_disable();
#endif
}

}  // namespace

OffscreenGl::OffscreenGl() {
  watch_leaks(false);
  const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
    failure_ = "EGL has no display without a surface";
    return;
  }
  display_ = display;
  const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  eglBindAPI(EGL_OPENGL_API);
  if (eglChooseConfig(display, wanted, &config, 1, &count) == EGL_FALSE || count == 0) config = nullptr;
  const EGLint version[] = {
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
  if (context == EGL_NO_CONTEXT || eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
    failure_ = "EGL gives no OpenGL 3.3 context";
    return;
  }
  context_ = context;
}

OffscreenGl::~OffscreenGl() {
  if (display_ != nullptr) {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != nullptr) eglDestroyContext(display_, context_);
    eglTerminate(display_);
  }
  watch_leaks(true);
}

}  // namespace bl::desktop
