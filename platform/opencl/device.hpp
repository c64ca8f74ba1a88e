#pragma once

#include <CL/opencl.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace touchstone {

struct DeviceConfig {
    /// auto (a GPU where there is one, else the CPU), gpu, cpu, or a part of the device's name.
    std::string choice = "auto";
    /// Where compiled programs are kept; empty: they are compiled at each start.
    std::filesystem::path cache_dir;
};

/// One OpenCL device with its context and one in-order queue.
class Device {
  public:
    /// Throws Error{unavailable} that names the devices there are when none fits.
    explicit Device(const DeviceConfig& config);

    const std::string& name() const { return name_; }
    bool is_cpu() const { return is_cpu_; }
    /// False for a card with memory of its own: what the host reads of it is copied.
    bool shares_memory() const { return shares_memory_; }
    std::uint64_t memory_bytes() const { return memory_bytes_; }
    const std::filesystem::path& cache_dir() const { return cache_dir_; }
    const cl::Device& handle() const { return device_; }
    const cl::Context& context() const { return context_; }
    const cl::CommandQueue& queue() const { return queue_; }
    /// What a binary depends on: platform, device and driver versions.
    std::string fingerprint() const;
    void finish() const;
    /// True once: what is wrong with the cache is so for all programs, and said once.
    bool is_first_unsaved_program() const { return !std::exchange(has_unsaved_programs_, true); }

  private:
    cl::Device device_;
    cl::Context context_;
    cl::CommandQueue queue_;
    std::string name_;
    bool is_cpu_ = true;
    bool shares_memory_ = true;
    std::uint64_t memory_bytes_ = 0;
    std::filesystem::path cache_dir_;
    mutable bool has_unsaved_programs_ = false;
};

/// $CACHE_DIRECTORY of a service, else $XDG_CACHE_HOME/touchstone, else ~/.cache/touchstone; empty when none
/// is set.
std::filesystem::path default_cache_dir();

}  // namespace touchstone
