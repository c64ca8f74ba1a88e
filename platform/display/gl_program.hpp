#pragma once

#include <string>
#include <string_view>

#include "platform/display/gl_handle.hpp"

namespace touchstone {

/// One shader: `path` names the file in error messages; the first line of `text` is `#version 310 es`.
struct ShaderSource {
    std::string_view path;
    std::string_view text;
};

/// A linked vertex and fragment shader. Throws Error{unavailable} with file and line when one does not
/// compile.
class GlProgram {
  public:
    GlProgram(const ShaderSource& vertex, const ShaderSource& fragment);

    void use() const { glUseProgram(handle_.id()); }
    /// -1, which GL ignores, when the program does not use a uniform of that name.
    GLint uniform(const char* name) const { return glGetUniformLocation(handle_.id(), name); }

  private:
    GlProgramHandle handle_;
};

/// The first error in a driver's compile log as "path:line: message". The line is left out where none is
/// recognised.
std::string first_shader_error(std::string_view path, const std::string& log);

}  // namespace touchstone
