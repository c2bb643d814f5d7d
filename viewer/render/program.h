// A linked shader program.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "viewer/render/gl_object.h"
#include "viewer/render/shaders.h"

namespace patchlab::viewer {

class Program {
 public:
  static Result<Program> link(const Embedded& vertex, const Embedded& fragment);

  void use() const { glUseProgram(program_.name()); }
  // Of the program in use. A name that the shader does not use is ignored.
  void set(const char* uniform, float value) const;
  void set(const char* uniform, const Eigen::Vector2f& value) const;
  void set(const char* uniform, const Eigen::Vector3f& value) const;
  void set(const char* uniform, const Eigen::Matrix4f& value) const;

 private:
  GLint location(const char* uniform) const { return glGetUniformLocation(program_.name(), uniform); }
  GlObject<ProgramKind> program_;
};

}  // namespace patchlab::viewer
