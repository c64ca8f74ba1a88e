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

GlProgram make_program(std::string_view name) { return make_program(name, name, {}); }

GlProgram make_program(std::string_view vertex, std::string_view fragment,
                       std::span<const std::string_view> macros) {
    const std::string base = "shaders/";
    const ShaderSource source = find_shader(base + std::string(fragment) + ".frag");
    const std::size_t version_end = source.text.find('\n') + 1;
    std::string text(source.text.substr(0, version_end));
    for (const std::string_view macro : macros) text += "#define " + std::string(macro) + " 1\n";
    text += "#line 2\n";
    text += source.text.substr(version_end);
    return {find_shader(base + std::string(vertex) + ".vert"), {source.path, text}};
}

}  // namespace touchstone
