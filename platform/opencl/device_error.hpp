#pragma once

#include <string>
#include <string_view>

#include "platform/system/error.hpp"

namespace touchstone {

/// A failed OpenCL call: the call (or kernel), the error's name and the device, in one line.
class DeviceError : public Error {
  public:
    DeviceError(std::string_view call, int code, std::string_view device);
    int code() const { return code_; }

  private:
    int code_;
};

/// The name of an OpenCL error code, such as CL_OUT_OF_RESOURCES.
std::string opencl_error_name(int code);

}  // namespace touchstone
