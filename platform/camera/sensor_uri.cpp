#include "platform/camera/sensor_uri.hpp"

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <fmt/core.h>
#include <system_error>
#include <unistd.h>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

constexpr std::string_view sequence_scheme = "seq:";
constexpr std::string_view simulator_scheme = "sim:";
constexpr std::size_t longest_uri = 255;

}  // namespace

SensorKind classify_sensor(const std::string& uri) {
    if (uri.starts_with(sequence_scheme)) return SensorKind::sequence;
    if (uri.starts_with(simulator_scheme)) return SensorKind::simulator;
    std::error_code code;
    if (std::filesystem::is_directory(uri, code)) {
        throw Error(ExitStatus::usage, fmt::format("sensor {0} is a folder: name it as seq:{0}", uri));
    }
    if (uri.ends_with(".oni") || std::filesystem::is_regular_file(uri, code)) return SensorKind::recording;
    return SensorKind::device;
}

OpenniUri::OpenniUri(const std::string& uri, SensorKind kind) : text_(uri) {
    if (uri.size() <= longest_uri) return;
    const bool sequence = kind == SensorKind::sequence;
    if (!sequence && kind != SensorKind::recording) {
        throw Error(ExitStatus::usage,
                    fmt::format("sensor {}... is longer than the {} characters OpenNI2 takes",
                                uri.substr(0, 60), longest_uri));
    }
    user_path_ = sequence ? uri.substr(sequence_scheme.size()) : uri;
    descriptor_ = ::open(user_path_.c_str(), O_PATH | O_CLOEXEC);
    if (descriptor_ < 0) {
        throw Error(ExitStatus::no_input,
                    fmt::format("cannot open {}: {}", user_path_, std::generic_category().message(errno)));
    }
    proc_path_ = fmt::format("/proc/self/fd/{}", descriptor_);
    text_ = sequence ? fmt::format("{}{}", sequence_scheme, proc_path_) : proc_path_;
}

OpenniUri::~OpenniUri() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

std::string OpenniUri::in_user_terms(std::string message) const {
    if (proc_path_.empty()) return message;
    for (std::size_t at = 0; (at = message.find(proc_path_, at)) != std::string::npos;
         at += user_path_.size()) {
        message.replace(at, proc_path_.size(), user_path_);
    }
    return message;
}

}  // namespace touchstone
