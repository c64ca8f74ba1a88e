#include "platform/display/egl_context.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl31.h>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

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

/// EGL_NO_DISPLAY: of the client.
bool has_extension(EGLDisplay display, std::string_view name) {
    const char* all = eglQueryString(display, EGL_EXTENSIONS);
    return all && std::string_view(all).find(name) != std::string_view::npos;
}

/// Mesa's surfaceless platform where it exists, else the driver's default display.
EGLDisplay open_display() {
    EGLDisplay display = EGL_NO_DISPLAY;
    if (has_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
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
    // One that says when the driver has given it up, where the driver can.
    const EGLint wants[] = {EGL_CONTEXT_MAJOR_VERSION,
                            3,
                            EGL_CONTEXT_MINOR_VERSION,
                            1,
                            EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT,
                            EGL_LOSE_CONTEXT_ON_RESET_EXT,
                            EGL_NONE};
    const EGLint plain_wants[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 1, EGL_NONE};
    EGLContext context = EGL_NO_CONTEXT;
    if (has_extension(display, "EGL_EXT_create_context_robustness"))
        context = eglCreateContext(display, config, EGL_NO_CONTEXT, wants);
    if (context == EGL_NO_CONTEXT) context = eglCreateContext(display, config, EGL_NO_CONTEXT, plain_wants);
    if (context == EGL_NO_CONTEXT) throw egl_error("eglCreateContext");
    return context;
}

/// Of the current context; null where it cannot tell.
EglContext::ResetStatus find_reset_status() {
    const auto* all = reinterpret_cast<const char*>(glGetString(GL_EXTENSIONS));
    const std::string_view extensions(all == nullptr ? "" : all);
    for (const auto& [extension, function] :
         {std::pair{"GL_KHR_robustness", "glGetGraphicsResetStatusKHR"},
          std::pair{"GL_EXT_robustness", "glGetGraphicsResetStatusEXT"}}) {
        if (extensions.find(extension) != std::string_view::npos)
            return reinterpret_cast<EglContext::ResetStatus>(eglGetProcAddress(function));
    }
    return nullptr;
}

}  // namespace

EglContext::EglContext() : display_(open_display()) {
    try {
        context_ = create_context(display_);
        if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
            throw egl_error("eglMakeCurrent");
        reset_status_ = find_reset_status();
    } catch (...) {
        if (context_) eglDestroyContext(display_, context_);
        throw;
    }
}

std::string EglContext::renderer() const {
    const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return name == nullptr ? "unknown" : name;
}

bool EglContext::was_reset() const { return reset_status_ != nullptr && reset_status_() != GL_NO_ERROR; }

// The EGLDisplay is one per process and shared by all contexts: eglTerminate would break the others.
EglContext::~EglContext() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    eglReleaseThread();
}

}  // namespace touchstone
