#include "platform/system/log.hpp"

#include <memory>
#include <spdlog/logger.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <string>

namespace touchstone {
namespace {

spdlog::level::level_enum spdlog_level(LogLevel level) {
    switch (level) {
        case LogLevel::debug:
            return spdlog::level::debug;
        case LogLevel::info:
            return spdlog::level::info;
        case LogLevel::warning:
            return spdlog::level::warn;
        case LogLevel::error:
            return spdlog::level::err;
    }
    return spdlog::level::info;
}

spdlog::logger& logger() {
    static spdlog::logger instance = [] {
        spdlog::logger made("touchstone", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
        made.set_pattern("%H:%M:%S.%e %^%-7l%$ %v");
        made.flush_on(spdlog::level::debug);
        return made;
    }();
    return instance;
}

}  // namespace

std::optional<LogLevel> parse_log_level(std::string_view word) {
    if (word == "debug") return LogLevel::debug;
    if (word == "info") return LogLevel::info;
    if (word == "warning") return LogLevel::warning;
    if (word == "error") return LogLevel::error;
    return std::nullopt;
}

void set_log_level(LogLevel level) { logger().set_level(spdlog_level(level)); }

void log_line(LogLevel level, std::string_view text) {
    logger().log(spdlog_level(level), spdlog::string_view_t(text.data(), text.size()));
}

}  // namespace touchstone
