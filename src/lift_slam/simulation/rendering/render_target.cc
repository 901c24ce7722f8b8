#include "lift_slam/simulation/rendering/render_target.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>
#include <fmt/format.h>

#include <algorithm>

#include "lift_slam/util/check.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

void CheckSize(int width, int height) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &limit);
  if (std::max(width, height) <= limit) return;
  throw InputError(fmt::format(
      "drawing needs a picture of {} x {} samples, but OpenGL allows {} at most: choose a "
      "smaller image or less supersampling",
      width, height, limit));
}

GlRenderbuffer MakeRenderbuffer(GLenum format, int width, int height) {
  GlName name = 0;
  glCreateRenderbuffers(1, &name);
  GlRenderbuffer buffer(name);
  glNamedRenderbufferStorage(name, format, width, height);
  return buffer;
}

}  // namespace

RenderTarget::RenderTarget(int width, int height) {
  CheckSize(width, height);
  color_ = MakeRenderbuffer(GL_RGBA8, width, height);
  depth_ = MakeRenderbuffer(GL_DEPTH_COMPONENT32F, width, height);
  GlName name = 0;
  glCreateFramebuffers(1, &name);
  framebuffer_ = GlFramebuffer(name);
  glNamedFramebufferRenderbuffer(name, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_.Name());
  glNamedFramebufferRenderbuffer(name, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.Name());
  const GLenum status = glCheckNamedFramebufferStatus(name, GL_FRAMEBUFFER);
  LIFT_SLAM_CHECK(status == GL_FRAMEBUFFER_COMPLETE, "frame buffer status {}", status);
}

void RenderTarget::Begin(int width, int height) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.Name());
  glViewport(0, 0, width, height);
  glDepthMask(GL_TRUE);
  glClearDepthf(0.0F);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void RenderTarget::Read(Samples& samples) const {
  GLint viewport[4] = {0, 0, 0, 0};
  glGetIntegerv(GL_VIEWPORT, viewport);
  samples.width = viewport[2];
  samples.height = viewport[3];
  const auto count =
      static_cast<std::size_t>(samples.width) * static_cast<std::size_t>(samples.height);
  samples.rgba.resize(4 * count);
  samples.depth.resize(count);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, samples.width, samples.height, GL_RGBA, GL_UNSIGNED_BYTE, samples.rgba.data());
  glReadPixels(0, 0, samples.width, samples.height, GL_DEPTH_COMPONENT, GL_FLOAT,
               samples.depth.data());
}

}  // namespace lift_slam
