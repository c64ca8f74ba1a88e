#include "platform/display/gl_error.hpp"

#include <GLES3/gl31.h>
#include <cstdio>

namespace touchstone {

std::string take_gl_errors() {
    std::string errors;
    // A lost context reports its error for ever, hence the limit.
    for (int i = 0; i < 16; ++i) {
        const GLenum error = glGetError();
        if (error == GL_NO_ERROR) break;
        char code[16];
        std::snprintf(code, sizeof code, "%s0x%04x", errors.empty() ? "" : " ", error);
        errors += code;
    }
    return errors;
}

std::string gl_description() {
    std::string line;
    for (const GLenum name : {GLenum{GL_VENDOR}, GLenum{GL_RENDERER}, GLenum{GL_VERSION}}) {
        const auto* text = reinterpret_cast<const char*>(glGetString(name));
        line += (line.empty() ? "" : ", ") + std::string(text ? text : "unknown");
    }
    return line;
}

}  // namespace touchstone
