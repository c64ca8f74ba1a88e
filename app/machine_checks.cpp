#include "app/machine_checks.hpp"

#include <fmt/format.h>
#include <set>
#include <system_error>
#include <unistd.h>

#include "app/bench_command.hpp"
#include "pipeline/self_test.hpp"
#include "platform/display/egl_context.hpp"
#include "platform/opencl/device_list.hpp"

namespace touchstone {
namespace {

namespace fs = std::filesystem;

constexpr int measured_frames = 40;
constexpr double fast_ms = 16.0, frame_ms = 33.3, slow_ms = 66.7;
constexpr std::uintmax_t mega = 1'000'000;
constexpr std::uintmax_t roomy = 500 * mega, tight = 50 * mega;

CheckLine check_device(const std::string& name, const Config& config) {
    const std::string subject = "OpenCL device";
    try {
        DeviceConfig device = device_config(config);
        device.choice = name;
        run_self_test(Device(device));
        return {subject, CheckStatus::ok, name + " computes what it should", {}};
    } catch (const Error& error) {
        return {subject, CheckStatus::warn, fmt::format("{}: {}", name, error.what()),
                "do not compute on it; [compute] device names the one to use"};
    }
}

CheckLine measure_speed(const Config& config) {
    try {
        BenchOptions options;
        options.config = config;
        options.config.sensor_uri = "sim:flat?hands=2&seed=1";
        options.frames = measured_frames;
        TerminationSignals signals;
        const BenchResult result = measure_frames(options, signals);
        return speed_line(result.frame.median_ms);
    } catch (const Error& error) {
        return {"speed", CheckStatus::fail, error.what(), "see the lines about OpenCL above"};
    }
}

}  // namespace

CheckLine check_configuration(const std::string& file, Config& config) {
    if (file.empty()) return {"configuration", CheckStatus::ok, "the defaults, no file is named", {}};
    try {
        load_config(file, config);
        return {"configuration", CheckStatus::ok, file, {}};
    } catch (const Error& error) {
        config = {};
        return {"configuration", CheckStatus::fail, error.what(),
                "touchstone run --print-config shows every key with its range"};
    }
}

std::vector<CheckLine> check_compute(const Config& config) {
    std::vector<CheckLine> lines;
    const std::vector<std::string> names = opencl_device_names();
    for (const std::string& name : std::set(names.begin(), names.end()))
        lines.push_back(check_device(name, config));
    if (lines.empty()) {
        return {{"OpenCL device", CheckStatus::fail, "there is none",
                 "install pocl-opencl-icd (CPU) or the driver of the GPU"}};
    }
    lines.push_back(measure_speed(config));
    return lines;
}

CheckLine speed_line(double median_frame_ms) {
    const std::string time = fmt::format("{:.0f} ms a frame", median_frame_ms);
    if (median_frame_ms <= fast_ms) return {"speed", CheckStatus::ok, "fast: " + time, {}};
    if (median_frame_ms <= frame_ms) return {"speed", CheckStatus::ok, "keeps 30 Hz: " + time, {}};
    const std::string advice = "close other programs, or scan with fewer voxels: [volume] size_vox = 256";
    if (median_frame_ms <= slow_ms)
        return {"speed", CheckStatus::warn, "slow, drops frames: " + time, advice};
    return {"speed", CheckStatus::fail, "too slow for touch: " + time, advice + ", or use a GPU"};
}

CheckLine check_drawing() {
    try {
        return {"drawing", CheckStatus::ok, EglContext().renderer(), {}};
    } catch (const Error& error) {
        return {"drawing", CheckStatus::fail, error.what(), "install libegl-mesa0 and libgl1-mesa-dri"};
    }
}

std::vector<CheckLine> output_lines(std::span<const Output> outputs) {
    std::vector<CheckLine> lines;
    for (const Output& output : outputs)
        lines.push_back({"outputs", CheckStatus::ok, list_text(std::span(&output, 1)), {}});
    if (!lines.empty()) return lines;
    return {{"outputs", CheckStatus::warn, "no screen or projector is connected",
             "connect one and switch it on; without one nothing is seen, and touches go out all the same"}};
}

CheckLine check_uinput(const fs::path& node) {
    if (access(node.c_str(), R_OK | W_OK) == 0)
        return {"uinput", CheckStatus::ok, node.string() + " may be used", {}};
    std::error_code code;
    return {"uinput", CheckStatus::fail,
            fmt::format("{} {}, and [uinput] is enabled", node.string(),
                        fs::exists(node, code) ? "may not be used by this user" : "is not there"),
            uinput_advice(node)};
}

CheckLine check_service(const fs::path& root) {
    std::error_code code;
    for (const char* target : {"multi-user", "graphical"}) {
        const fs::path link =
            root / fmt::format("etc/systemd/system/{}.target.wants/touchstone.service", target);
        if (fs::is_symlink(link, code) || fs::exists(link, code))
            return {"service", CheckStatus::ok, "touchstone.service starts with the machine", {}};
    }
    for (const char* folder : {"etc/systemd/system", "lib/systemd/system", "usr/lib/systemd/system"}) {
        if (fs::exists(root / folder / "touchstone.service", code))
            return {"service", CheckStatus::warn, "touchstone.service is there but does not start by itself",
                    "sudo systemctl enable --now touchstone"};
    }
    return {"service", CheckStatus::warn, "touchstone does not start with the machine: no touchstone.service",
            "toolchain/package makes a package with one; README.md, As a service, has the three commands"};
}

fs::path existing_part(const fs::path& folder) {
    std::error_code code;
    fs::path place = folder.empty() ? fs::current_path(code) : fs::absolute(folder, code);
    while (!fs::exists(place, code) && place.has_relative_path()) place = place.parent_path();
    return place;
}

CheckLine check_disk(const fs::path& folder) {
    std::error_code code;
    const fs::path place = existing_part(folder);
    const fs::space_info space = fs::space(place, code);
    if (code) return {"disk", CheckStatus::warn, place.string() + ": " + code.message(), "mount it"};
    const std::string finding = fmt::format("{} MB free at {}", space.available / mega, place.string());
    if (space.available >= roomy) return {"disk", CheckStatus::ok, finding, {}};
    return {"disk", space.available >= tight ? CheckStatus::warn : CheckStatus::fail, finding,
            "make room: scans and compiled kernels take up to 50 MB"};
}

}  // namespace touchstone
