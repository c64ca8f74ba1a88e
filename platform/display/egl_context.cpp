#include "platform/display/egl_context.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl31.h>
#include <cstdio>
#include <string>
#include <string_view>

#include "platform/system/error.hpp"

namespace touchstone {

namespace {

Error egl_error(const char* step) {
    char code[16];
    std::snprintf(code, sizeof code, "0x%04x", static_cast<unsigned>(eglGetError()));
    return {ExitStatus::unavailable,
            std::string("No OpenGL ES 3.1 without a screen: ") + step + " failed (EGL error " + code +
                "); install the graphics driver (Debian: libegl-mesa0 and libgles2)"};
}

bool has_client_extension(std::string_view name) {
    const char* all = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    return all && std::string_view(all).find(name) != std::string_view::npos;
}

/// Mesa's surfaceless platform where it exists, else the driver's default display.
EGLDisplay open_display() {
    EGLDisplay display = EGL_NO_DISPLAY;
    if (has_client_extension("EGL_MESA_platform_surfaceless"))
        display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY) display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    if (display == EGL_NO_DISPLAY) throw egl_error("eglGetPlatformDisplay");
    if (!eglInitialize(display, nullptr, nullptr)) throw egl_error("eglInitialize");
    return display;
}

EGLContext create_context(EGLDisplay display) {
    if (!eglBindAPI(EGL_OPENGL_ES_API)) throw egl_error("eglBindAPI");
    const EGLint config_wants[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    if (!eglChooseConfig(display, config_wants, &config, 1, &found) || found == 0)
        throw egl_error("eglChooseConfig");
    const EGLint wants[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 1, EGL_NONE};
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, wants);
    if (context == EGL_NO_CONTEXT) throw egl_error("eglCreateContext");
    return context;
}

}  // namespace

EglContext::EglContext() : display_(open_display()) {
    try {
        context_ = create_context(display_);
        if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
            throw egl_error("eglMakeCurrent");
    } catch (...) {
        if (context_) eglDestroyContext(display_, context_);
        throw;
    }
}

std::string EglContext::renderer() const {
    const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return name == nullptr ? "unknown" : name;
}

// The EGLDisplay is one per process and shared by all contexts: eglTerminate would break the others.
EglContext::~EglContext() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    eglReleaseThread();
}

}  // namespace touchstone
