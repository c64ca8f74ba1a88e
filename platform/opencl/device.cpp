#include "platform/opencl/device.hpp"

#include <cstdlib>
#include <optional>
#include <sched.h>
#include <unistd.h>
#include <vector>

#include "platform/opencl/device_error.hpp"
#include "platform/opencl/device_list.hpp"

namespace touchstone {

namespace {

/// A core for each of PoCL's threads: Linux else often wakes two of them on one core, and a kernel of a
/// millisecond is over before the other core helps. PoCL counts cores from 0 and fails on one that it may not
/// use, so that a process kept to some of them is left as it is; so is the user's own choice.
void pin_pocl_threads() {
    cpu_set_t allowed;
    CPU_ZERO(&allowed);
    if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
    const auto cores = sysconf(_SC_NPROCESSORS_ONLN);
    if (cores < 1 || CPU_COUNT(&allowed) != cores || !CPU_ISSET(cores - 1, &allowed)) return;
    setenv("POCL_AFFINITY", "1", 0);
}

std::vector<cl::Device> all_devices() {
    pin_pocl_threads();
    std::vector<cl::Device> devices;
    std::vector<cl::Platform> platforms;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error&) {
        return devices;  // the loader reports "no platform" as an error
    }
    for (const cl::Platform& platform : platforms) {
        std::vector<cl::Device> found;
        try {
            platform.getDevices(CL_DEVICE_TYPE_ALL, &found);
        } catch (const cl::Error&) {
            continue;  // a platform without a device
        }
        devices.insert(devices.end(), found.begin(), found.end());
    }
    return devices;
}

bool has_type(const cl::Device& device, cl_device_type type) {
    return (device.getInfo<CL_DEVICE_TYPE>() & type) != 0;
}

std::optional<cl::Device> choose(const std::vector<cl::Device>& devices, const std::string& choice) {
    auto first = [&](auto&& fits) -> std::optional<cl::Device> {
        for (const cl::Device& device : devices) {
            if (fits(device)) return device;
        }
        return std::nullopt;
    };
    auto gpu = [](const cl::Device& device) { return has_type(device, CL_DEVICE_TYPE_GPU); };
    auto cpu = [](const cl::Device& device) { return has_type(device, CL_DEVICE_TYPE_CPU); };
    if (choice == "gpu") return first(gpu);
    if (choice == "cpu") return first(cpu);
    if (choice != "auto") {
        return first([&](const cl::Device& device) {
            return device.getInfo<CL_DEVICE_NAME>().find(choice) != std::string::npos;
        });
    }
    if (auto found = first(gpu)) return found;
    if (auto found = first(cpu)) return found;
    return first([](const cl::Device&) { return true; });
}

std::string list_names(const std::vector<cl::Device>& devices) {
    std::string names;
    for (const cl::Device& device : devices) {
        names += (names.empty() ? "" : ", ") + device.getInfo<CL_DEVICE_NAME>();
    }
    return names;
}

}  // namespace

Device::Device(const DeviceConfig& config) : cache_dir_(config.cache_dir) {
    const std::vector<cl::Device> devices = all_devices();
    if (devices.empty()) {
        throw Error(ExitStatus::unavailable,
                    "no OpenCL device found: install pocl-opencl-icd (CPU) or the driver of the GPU");
    }
    const std::optional<cl::Device> chosen = choose(devices, config.choice);
    if (!chosen) {
        throw Error(ExitStatus::unavailable, "no OpenCL device fits compute.device = \"" + config.choice +
                                                 "\"; there is: " + list_names(devices));
    }
    device_ = *chosen;
    name_ = device_.getInfo<CL_DEVICE_NAME>();
    is_cpu_ = has_type(device_, CL_DEVICE_TYPE_CPU);
    try {
        shares_memory_ = device_.getInfo<CL_DEVICE_HOST_UNIFIED_MEMORY>() == CL_TRUE;
        memory_bytes_ = device_.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
        context_ = cl::Context(device_);
        queue_ = cl::CommandQueue(context_, device_);
    } catch (const cl::Error& error) {
        throw DeviceError(error.what(), error.err(), name_);
    }
}

std::string Device::fingerprint() const {
    const cl::Platform platform(device_.getInfo<CL_DEVICE_PLATFORM>());
    return platform.getInfo<CL_PLATFORM_VERSION>() + "|" + name_ + "|" +
           device_.getInfo<CL_DEVICE_VERSION>() + "|" + device_.getInfo<CL_DRIVER_VERSION>();
}

void Device::finish() const {
    try {
        queue_.finish();
    } catch (const cl::Error& error) {
        throw DeviceError("clFinish", error.err(), name_);
    }
}

std::vector<std::string> opencl_device_names() {
    std::vector<std::string> names;
    for (const cl::Device& device : all_devices()) names.push_back(device.getInfo<CL_DEVICE_NAME>());
    return names;
}

std::filesystem::path default_cache_dir() {
    if (const char* service = std::getenv("CACHE_DIRECTORY")) return service;
    if (const char* xdg = std::getenv("XDG_CACHE_HOME")) return std::filesystem::path(xdg) / "touchstone";
    if (const char* home = std::getenv("HOME")) return std::filesystem::path(home) / ".cache" / "touchstone";
    return {};
}

}  // namespace touchstone
