#pragma once

#include <GLES3/gl31.h>
#include <utility>

namespace touchstone {

inline void delete_gl_texture(GLuint id) { glDeleteTextures(1, &id); }
inline void delete_gl_buffer(GLuint id) { glDeleteBuffers(1, &id); }
inline void delete_gl_framebuffer(GLuint id) { glDeleteFramebuffers(1, &id); }
inline void delete_gl_renderbuffer(GLuint id) { glDeleteRenderbuffers(1, &id); }
inline void delete_gl_vertex_array(GLuint id) { glDeleteVertexArrays(1, &id); }
inline void delete_gl_shader(GLuint id) { glDeleteShader(id); }
inline void delete_gl_program(GLuint id) { glDeleteProgram(id); }

/// Owns one GL name; 0 owns nothing. The context must be current where it is destroyed.
template <void (*Delete)(GLuint)>
class GlHandle {
  public:
    GlHandle() = default;
    explicit GlHandle(GLuint id) : id_(id) {}
    GlHandle(GlHandle&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    GlHandle& operator=(GlHandle&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~GlHandle() {
        if (id_ != 0) Delete(id_);
    }
    GLuint id() const { return id_; }

  private:
    GLuint id_ = 0;
};

using GlTextureHandle = GlHandle<delete_gl_texture>;
using GlBufferHandle = GlHandle<delete_gl_buffer>;
using GlFramebufferHandle = GlHandle<delete_gl_framebuffer>;
using GlRenderbufferHandle = GlHandle<delete_gl_renderbuffer>;
using GlVertexArrayHandle = GlHandle<delete_gl_vertex_array>;
using GlShaderHandle = GlHandle<delete_gl_shader>;
using GlProgramHandle = GlHandle<delete_gl_program>;

inline GLuint new_gl_texture() {
    GLuint id = 0;
    glGenTextures(1, &id);
    return id;
}
inline GLuint new_gl_buffer() {
    GLuint id = 0;
    glGenBuffers(1, &id);
    return id;
}
inline GLuint new_gl_framebuffer() {
    GLuint id = 0;
    glGenFramebuffers(1, &id);
    return id;
}
inline GLuint new_gl_renderbuffer() {
    GLuint id = 0;
    glGenRenderbuffers(1, &id);
    return id;
}
inline GLuint new_gl_vertex_array() {
    GLuint id = 0;
    glGenVertexArrays(1, &id);
    return id;
}

}  // namespace touchstone
