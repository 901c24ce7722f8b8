#include "lift_slam/simulation/rendering/gl_scene.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include <algorithm>
#include <cstddef>

#include "lift_slam/simulation/rendering/shaders.h"
#include "lift_slam/simulation/rendering/texture_pyramid.h"

namespace lift_slam {
namespace {

GlTexture Upload(const SceneTexture& picture) {
  const std::vector<TextureLevel> levels = MakeTexturePyramid(picture);
  GlName name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  GlTexture texture(name);
  glTextureStorage2D(name, static_cast<GLsizei>(levels.size()), GL_RGBA8, picture.width,
                     picture.height);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    glTextureSubImage2D(name, static_cast<GLint>(i), 0, 0, levels[i].width, levels[i].height,
                        GL_RGBA, GL_UNSIGNED_BYTE, levels[i].rgba.data());
  }
  return texture;
}

SceneTexture White() { return {"white", 1, 1, false, {255, 255, 255, 255}}; }

GlSampler MakeSampler(GLint wrap_v) {
  GlName name = 0;
  glCreateSamplers(1, &name);
  glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glSamplerParameteri(name, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glSamplerParameteri(name, GL_TEXTURE_WRAP_T, wrap_v);
  return GlSampler(name);
}

GlBuffer MakeBuffer(const void* data, std::size_t bytes) {
  GlName name = 0;
  glCreateBuffers(1, &name);
  GlBuffer buffer(name);
  // OpenGL refuses empty storage; a scene of sky alone is none the less a scene.
  glNamedBufferStorage(name, static_cast<GLsizeiptr>(std::max<std::size_t>(bytes, 4)),
                       bytes == 0 ? nullptr : data, 0);
  return buffer;
}

void AddInput(GlName layout, unsigned int input, GLint size, std::size_t offset) {
  glEnableVertexArrayAttrib(layout, input);
  glVertexArrayAttribFormat(layout, input, size, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
  glVertexArrayAttribBinding(layout, input, 0);
}

}  // namespace

GlTextures::GlTextures(const Scene& scene)
    : surface_(MakeSampler(GL_REPEAT)), sky_(MakeSampler(GL_CLAMP_TO_EDGE)) {
  for (const SceneTexture& texture : scene.textures) textures_.push_back(Upload(texture));
  textures_.push_back(Upload(White()));
}

void GlTextures::Bind(unsigned int unit, int index) const {
  const GlTexture& texture =
      index < 0 ? textures_.back() : textures_[static_cast<std::size_t>(index)];
  glBindTextureUnit(unit, texture.Name());
}

void GlTextures::BindSurface(unsigned int unit, int index) const {
  Bind(unit, index);
  glBindSampler(unit, surface_.Name());
}

void GlTextures::BindSky(unsigned int unit, int index) const {
  Bind(unit, index);
  glBindSampler(unit, sky_.Name());
}

GlGeometry::GlGeometry(const ChunkedScene& scene)
    : vertices_(MakeBuffer(scene.vertices.data(), scene.vertices.size() * sizeof(DrawVertex))),
      indices_(MakeBuffer(scene.indices.data(), scene.indices.size() * sizeof(std::uint32_t))) {
  GlName name = 0;
  glCreateVertexArrays(1, &name);
  layout_ = GlVertexArray(name);
  glVertexArrayVertexBuffer(name, 0, vertices_.Name(), 0, sizeof(DrawVertex));
  glVertexArrayElementBuffer(name, indices_.Name());
  AddInput(name, kPositionInput, 3, offsetof(DrawVertex, position));
  AddInput(name, kTextureInput, 4, offsetof(DrawVertex, uv));
  AddInput(name, kSunInput, 1, offsetof(DrawVertex, sun_cosine));
}

void GlGeometry::Bind() const { glBindVertexArray(layout_.Name()); }

}  // namespace lift_slam
