#include "lift_slam/simulation/rendering/gl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <array>
#include <string>

#include "lift_slam/util/check.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

[[noreturn]] void ThrowNoContext(const std::string& step) {
  throw InputError(fmt::format(
      "cannot draw without a screen: {} failed (EGL error 0x{:x}); install Mesa's software "
      "renderer, Debian packages libegl-mesa0 and libgl1-mesa-dri",
      step, eglGetError()));
}

// Displays are shared by all contexts of the process and never closed: that would end them all.
EGLDisplay OpenDisplay() {
  const EGLDisplay display =
      eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY) ThrowNoContext("opening Mesa's surfaceless display");
  if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE) ThrowNoContext("starting EGL");
  return display;
}

EGLContext CreateContext(EGLDisplay display) {
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) ThrowNoContext("choosing OpenGL");
  constexpr std::array<EGLint, 7> kAttributes = {EGL_CONTEXT_MAJOR_VERSION,
                                                 4,
                                                 EGL_CONTEXT_MINOR_VERSION,
                                                 5,
                                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                 EGL_NONE};
  const EGLContext context =
      eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kAttributes.data());
  if (context == EGL_NO_CONTEXT) ThrowNoContext("creating an OpenGL 4.5 context");
  return context;
}

}  // namespace

GlContext::GlContext() : display_(OpenDisplay()), context_(CreateContext(display_)) {}

GlContext::~GlContext() { eglDestroyContext(display_, context_); }

GlContext::Scope::Scope(const GlContext& context) : display_(context.display_) {
  // The bound API is a state of the thread.
  LIFT_SLAM_CHECK(eglBindAPI(EGL_OPENGL_API) == EGL_TRUE, "EGL lost OpenGL");
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context.context_) == EGL_FALSE) {
    ThrowNoContext("making the OpenGL context current");
  }
}

GlContext::Scope::~Scope() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

}  // namespace lift_slam
