#include "ui/shader.hpp"

#include <stdexcept>
#include <string>

#include "shader_sources.hpp"

namespace touchstone {

namespace {

ShaderSource find_shader(const std::string& name) {
    for (const shader_sources_file& file : shader_sources())
        if (file.name == name) return {file.path, file.text};
    throw std::logic_error("ui/" + name + " is not embedded; add it to ui/CMakeLists.txt");
}

}  // namespace

GlProgram make_program(std::string_view name) {
    const std::string base = "shaders/" + std::string(name);
    return {find_shader(base + ".vert"), find_shader(base + ".frag")};
}

}  // namespace touchstone
