#include "lift_slam/simulation/rendering/gl_objects.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

GlName CompileShader(GLenum kind, const std::string& source) {
  const GlName shader = glCreateShader(kind);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  std::string log(2000, '\0');
  if (compiled != GL_TRUE) glGetShaderInfoLog(shader, 2000, nullptr, log.data());
  LIFT_SLAM_CHECK(compiled == GL_TRUE, "shader: {}", log.c_str());
  return shader;
}

}  // namespace

void DeleteGlBuffer(GlName name) { glDeleteBuffers(1, &name); }
void DeleteGlVertexArray(GlName name) { glDeleteVertexArrays(1, &name); }
void DeleteGlTexture(GlName name) { glDeleteTextures(1, &name); }
void DeleteGlSampler(GlName name) { glDeleteSamplers(1, &name); }
void DeleteGlRenderbuffer(GlName name) { glDeleteRenderbuffers(1, &name); }
void DeleteGlFramebuffer(GlName name) { glDeleteFramebuffers(1, &name); }
void DeleteGlProgram(GlName name) { glDeleteProgram(name); }

GlProgram MakeGlProgram(const std::string& vertex_source, const std::string& fragment_source) {
  const GlName vertex = CompileShader(GL_VERTEX_SHADER, vertex_source);
  const GlName fragment = CompileShader(GL_FRAGMENT_SHADER, fragment_source);
  GlProgram program(glCreateProgram());
  glAttachShader(program.Name(), vertex);
  glAttachShader(program.Name(), fragment);
  glLinkProgram(program.Name());
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint linked = GL_FALSE;
  glGetProgramiv(program.Name(), GL_LINK_STATUS, &linked);
  std::string log(2000, '\0');
  if (linked != GL_TRUE) glGetProgramInfoLog(program.Name(), 2000, nullptr, log.data());
  LIFT_SLAM_CHECK(linked == GL_TRUE, "shader program: {}", log.c_str());
  return program;
}

}  // namespace lift_slam
