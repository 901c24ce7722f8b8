#pragma once

#include <string>
#include <utility>

namespace lift_slam {

// Owners of OpenGL objects. Creating, using and destroying them needs the current context they
// belong to (GlContext::Scope).
using GlName = unsigned int;

void DeleteGlBuffer(GlName name);
void DeleteGlVertexArray(GlName name);
void DeleteGlTexture(GlName name);
void DeleteGlSampler(GlName name);
void DeleteGlRenderbuffer(GlName name);
void DeleteGlFramebuffer(GlName name);
void DeleteGlProgram(GlName name);

template <void (*Delete)(GlName)>
class GlObject {
 public:
  GlObject() = default;
  explicit GlObject(GlName name) : name_(name) {}
  ~GlObject() {
    if (name_ != 0) Delete(name_);
  }
  GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  GlObject(const GlObject&) = delete;
  GlObject& operator=(const GlObject&) = delete;

  GlName Name() const { return name_; }

 private:
  GlName name_ = 0;
};

using GlBuffer = GlObject<DeleteGlBuffer>;
using GlVertexArray = GlObject<DeleteGlVertexArray>;
using GlTexture = GlObject<DeleteGlTexture>;
using GlSampler = GlObject<DeleteGlSampler>;
using GlRenderbuffer = GlObject<DeleteGlRenderbuffer>;
using GlFramebuffer = GlObject<DeleteGlFramebuffer>;
using GlProgram = GlObject<DeleteGlProgram>;

// Compiles and links; a mistake in the sources is a CheckError with the compiler's words.
GlProgram MakeGlProgram(const std::string& vertex_source, const std::string& fragment_source);

}  // namespace lift_slam
