#pragma once

#include <CL/opencl.hpp>
#include <array>
#include <span>
#include <string>
#include <string_view>

#include "platform/opencl/buffer.hpp"
#include "platform/opencl/device.hpp"

namespace touchstone {

/// One source text with the path that build messages shall name.
struct ProgramSource {
    std::string_view path;
    std::string_view text;
};

/// The first line of a driver's build log that names an error, else the whole log. Where it names none of the
/// sources, as from drivers that pass over #line (NVIDIA's), its line is taken for one of the joined text.
std::string first_build_error(const std::string& log, std::span<const ProgramSource> sources);

/// Global and local sizes of a launch, in whole work-groups, and the first global id. The local size is never
/// left to the device: PoCL would compile the kernel anew for each size it chooses.
struct LaunchSize {
    std::array<std::size_t, 3> global{1, 1, 1};
    std::array<std::size_t, 3> local{1, 1, 1};
    std::array<std::size_t, 3> first{0, 0, 0};
};

constexpr std::size_t ceil_div(std::size_t value, std::size_t divisor) {
    return (value + divisor - 1) / divisor;
}
constexpr std::size_t round_up(std::size_t value, std::size_t multiple) {
    return ceil_div(value, multiple) * multiple;
}

/// One kernel; launch() sets the arguments in order (buffers and plain structs) and queues it.
class Kernel {
  public:
    Kernel(const Device& device, cl::Kernel kernel, std::string name)
        : device_(&device), kernel_(std::move(kernel)), name_(std::move(name)) {}

    template <class... Args>
    void launch(const LaunchSize& size, const Args&... args) {
        cl_uint index = 0;
        try {
            (set(index++, args), ...);
            enqueue(size);
        } catch (const cl::Error& error) {
            throw DeviceError("kernel " + name_ + ": " + error.what(), error.err(), device_->name());
        }
    }

  private:
    template <class T>
    void set(cl_uint index, const Buffer<T>& buffer) {
        kernel_.setArg(index, buffer.handle());
    }
    template <class T>
    void set(cl_uint index, const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        kernel_.setArg(index, sizeof(T), &value);
    }
    void enqueue(const LaunchSize& size);

    const Device* device_;
    cl::Kernel kernel_;
    std::string name_;
};

/// A program built from sources in order, warnings as errors; its binary is kept in the device's cache
/// folder.
class Program {
  public:
    /// Throws Error{unavailable} with the first message of the build log (file and line) when it does not
    /// build.
    Program(const Device& device, std::span<const ProgramSource> sources, std::string_view options = "");

    Kernel kernel(const std::string& name) const;
    bool came_from_cache() const { return came_from_cache_; }

  private:
    const Device* device_;
    cl::Program program_;
    std::string file_;
    bool came_from_cache_ = false;
};

}  // namespace touchstone
