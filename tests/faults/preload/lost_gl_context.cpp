// LD_PRELOAD: a GL context that its driver has given up. A new context is whole again.
#include <EGL/egl.h>
#include <GLES3/gl31.h>
#include <atomic>
#include <cstring>
#include <dlfcn.h>

#include "tests/faults/preload/fault_switch.hpp"

namespace {

std::atomic<bool> is_lost{false};
constexpr GLenum unknown_context_reset = 0x8255;

GLenum reset_status() {
    if (fault_is_on()) {
        unlink(std::getenv("TOUCHSTONE_FAULT_SWITCH"));
        is_lost = true;
    }
    return is_lost ? unknown_context_reset : GL_NO_ERROR;
}

using Function = void (*)();

}  // namespace

extern "C" Function eglGetProcAddress(const char* name) {
    static const auto next =
        reinterpret_cast<Function (*)(const char*)>(dlsym(RTLD_NEXT, "eglGetProcAddress"));
    if (std::strncmp(name, "glGetGraphicsResetStatus", 24) == 0)
        return reinterpret_cast<Function>(reset_status);
    return next(name);
}

extern "C" EGLContext eglCreateContext(EGLDisplay display, EGLConfig config, EGLContext share,
                                       const EGLint* wants) {
    static const auto next =
        reinterpret_cast<decltype(&eglCreateContext)>(dlsym(RTLD_NEXT, "eglCreateContext"));
    is_lost = false;
    return next(display, config, share, wants);
}
