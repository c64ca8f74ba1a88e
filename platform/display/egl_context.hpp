#pragma once

#include <string>

namespace touchstone {

/// An OpenGL ES 3.1 context without a surface, current on the thread that makes it until it is destroyed
/// there. Throws Error{unavailable} where the EGL driver is missing or too old.
class EglContext {
  public:
    EglContext();
    ~EglContext();
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    /// What draws, in the driver's words.
    std::string renderer() const;

  private:
    void* display_ = nullptr;
    void* context_ = nullptr;
};

}  // namespace touchstone
