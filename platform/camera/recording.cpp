#include "platform/camera/recording.hpp"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fmt/core.h>
#include <system_error>
#include <thread>

#include "platform/camera/openni_error.hpp"
#include "platform/system/error.hpp"

namespace touchstone {
namespace {

/// OpenNI's recorder crashes where it cannot open its file: try before it does.
void check_writable(const std::string& path) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (file == nullptr) {
        throw Error(ExitStatus::io_error,
                    fmt::format("cannot record to {}: {}", path, std::generic_category().message(errno)));
    }
    std::fclose(file);
}

[[noreturn]] void fail(const std::string& path) {
    throw Error(ExitStatus::io_error,
                fmt::format("cannot record to {}: {}", path, one_line(openni::OpenNI::getExtendedError())));
}

/// OpenNI starts a recorder in a thread of its own and drops what comes before; it has started some time
/// after it has written the streams' properties, and says so nowhere. Wait until the file has stopped growing
/// for a while.
void wait_until_started(const std::string& path) {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds quiet(250), longest(3000);
    const auto begin = Clock::now();
    auto last_growth = begin;
    std::uintmax_t size = 0;
    while (Clock::now() - begin < longest && (size == 0 || Clock::now() - last_growth < quiet)) {
        std::error_code code;
        const std::uintmax_t now = std::filesystem::file_size(path, code);
        if (!code && now != size) {
            size = now;
            last_growth = Clock::now();
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

}  // namespace

Recording::Recording(const std::string& path, openni::VideoStream& depth, openni::VideoStream& color) {
    check_writable(path);
    if (recorder_.create(path.c_str()) != openni::STATUS_OK) fail(path);
    if (recorder_.attach(depth) != openni::STATUS_OK) fail(path);
    if (color.isValid() && recorder_.attach(color, true) != openni::STATUS_OK) fail(path);
    if (recorder_.start() != openni::STATUS_OK) fail(path);
    wait_until_started(path);
}

Recording::~Recording() { recorder_.destroy(); }

}  // namespace touchstone
