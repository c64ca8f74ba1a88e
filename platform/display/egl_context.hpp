#pragma once

#include <string>

namespace touchstone {

/// An OpenGL ES 3.1 context without a surface, current on the thread that makes it until it is destroyed
/// there. Throws Error{unavailable} where the EGL driver is missing or too old.
class EglContext {
  public:
    using ResetStatus = unsigned int (*)();

    EglContext();
    ~EglContext();
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    /// What draws, in the driver's words.
    std::string renderer() const;
    /// The driver has given it up: a hung or reset GPU. False where the driver cannot tell.
    bool was_reset() const;

  private:
    void* display_ = nullptr;
    void* context_ = nullptr;
    ResetStatus reset_status_ = nullptr;
};

}  // namespace touchstone
