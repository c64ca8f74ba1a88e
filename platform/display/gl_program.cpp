#include "platform/display/gl_program.hpp"

#include "platform/system/error.hpp"

namespace touchstone {

namespace {

GlShaderHandle compile(GLenum stage, const ShaderSource& source) {
    GlShaderHandle shader(glCreateShader(stage));
    const char* text = source.text.data();
    const auto length = static_cast<GLint>(source.text.size());
    glShaderSource(shader.id(), 1, &text, &length);
    glCompileShader(shader.id());
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
    if (compiled) return shader;
    std::string log(4096, '\0');
    GLsizei used = 0;
    glGetShaderInfoLog(shader.id(), static_cast<GLsizei>(log.size()), &used, log.data());
    log.resize(static_cast<std::size_t>(used));
    throw Error(ExitStatus::unavailable, first_shader_error(source.path, log));
}

}  // namespace

// Mesa writes "0:12(5): error: ...", Mali and ANGLE "ERROR: 0:12: ...", NVIDIA "0(12) : error ...": the line
// is the second number, the message follows the next ": ".
std::string first_shader_error(std::string_view path, const std::string& log) {
    const std::string line = log.substr(0, log.find('\n'));
    constexpr const char* digits = "0123456789";
    const std::size_t source = line.find_first_of(digits);
    const std::size_t mark = line.find_first_not_of(digits, source);
    const bool recognised = source == 0 || line.rfind("ERROR: ", 0) == 0;
    if (recognised && mark != std::string::npos && (line[mark] == ':' || line[mark] == '(')) {
        const std::size_t end = line.find_first_not_of(digits, mark + 1);
        const std::size_t message = line.find(": ", mark + 1);
        if (end != std::string::npos && end > mark + 1 && message != std::string::npos)
            return std::string(path) + ":" + line.substr(mark + 1, end - mark - 1) + line.substr(message);
    }
    return std::string(path) + ": " + line;
}

GlProgram::GlProgram(const ShaderSource& vertex, const ShaderSource& fragment) {
    const GlShaderHandle vertex_shader = compile(GL_VERTEX_SHADER, vertex);
    const GlShaderHandle fragment_shader = compile(GL_FRAGMENT_SHADER, fragment);
    handle_ = GlProgramHandle(glCreateProgram());
    glAttachShader(handle_.id(), vertex_shader.id());
    glAttachShader(handle_.id(), fragment_shader.id());
    glLinkProgram(handle_.id());
    GLint linked = GL_FALSE;
    glGetProgramiv(handle_.id(), GL_LINK_STATUS, &linked);
    if (linked) return;
    std::string log(4096, '\0');
    GLsizei used = 0;
    glGetProgramInfoLog(handle_.id(), static_cast<GLsizei>(log.size()), &used, log.data());
    log.resize(static_cast<std::size_t>(used));
    throw Error(ExitStatus::unavailable, std::string(vertex.path) + " and " + std::string(fragment.path) +
                                             " do not link: " + log.substr(0, log.find('\n')));
}

}  // namespace touchstone
