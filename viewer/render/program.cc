#include "viewer/render/program.h"

#include "engine/base/file.h"

namespace patchlab::viewer {
namespace {

std::string source_of(const Embedded& shader) {
#ifdef PATCHLAB_SHADER_FOLDER
  const std::filesystem::path file = std::filesystem::path(PATCHLAB_SHADER_FOLDER) / shader.file;
  if (Result<Bytes> bytes = read_file(file)) return std::string(as_text(*bytes));
#endif
  return std::string(reinterpret_cast<const char*>(shader.bytes), shader.size);
}

Result<void> compile(GLuint name, const Embedded& shader) {
  const std::string source = source_of(shader);
  const char* text = source.c_str();
  glShaderSource(name, 1, &text, nullptr);
  glCompileShader(name);
  GLint compiled = GL_FALSE;
  glGetShaderiv(name, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return {};
  char log[512] = "";
  glGetShaderInfoLog(name, sizeof log, nullptr, log);
  return Error{ErrorCode::usage,
               std::string("The graphics driver does not compile the shader ") + shader.file + " (" + log +
                   "); update the driver, or set LIBGL_ALWAYS_SOFTWARE=1 to draw without it."};
}

}  // namespace

Result<Program> Program::link(const Embedded& vertex, const Embedded& fragment) {
  const GlObject<VertexShaderKind> vertex_shader;
  const GlObject<FragmentShaderKind> fragment_shader;
  if (Result<void> compiled = compile(vertex_shader.name(), vertex); !compiled) return compiled.error();
  if (Result<void> compiled = compile(fragment_shader.name(), fragment); !compiled) return compiled.error();
  Program program;
  const GLuint name = program.program_.name();
  glAttachShader(name, vertex_shader.name());
  glAttachShader(name, fragment_shader.name());
  glLinkProgram(name);
  GLint linked = GL_FALSE;
  glGetProgramiv(name, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return program;
  return Error{ErrorCode::usage, std::string("The graphics driver does not link the shaders ") + vertex.file +
                                     " and " + fragment.file +
                                     "; update it, or set LIBGL_ALWAYS_SOFTWARE=1 to draw without it."};
}

void Program::set(const char* uniform, float value) const { glUniform1f(location(uniform), value); }
void Program::set(const char* uniform, const Eigen::Vector2f& value) const {
  glUniform2fv(location(uniform), 1, value.data());
}
void Program::set(const char* uniform, const Eigen::Vector3f& value) const {
  glUniform3fv(location(uniform), 1, value.data());
}
void Program::set(const char* uniform, const Eigen::Matrix4f& value) const {
  glUniformMatrix4fv(location(uniform), 1, GL_FALSE, value.data());
}

}  // namespace patchlab::viewer
