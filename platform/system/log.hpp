#pragma once

#include <fmt/core.h>
#include <optional>
#include <string_view>
#include <utility>

namespace touchstone {

enum class LogLevel { debug, info, warning, error };

/// "debug", "info", "warning" or "error"; nothing for any other word.
std::optional<LogLevel> parse_log_level(std::string_view word);

/// Lines below this level are dropped. Info until it is called.
void set_log_level(LogLevel level);

/// One line on standard error: time, level, text. May be called from any thread.
void log_line(LogLevel level, std::string_view text);

template <class... Args>
void log_debug(fmt::format_string<Args...> format, Args&&... args) {
    log_line(LogLevel::debug, fmt::format(format, std::forward<Args>(args)...));
}

template <class... Args>
void log_info(fmt::format_string<Args...> format, Args&&... args) {
    log_line(LogLevel::info, fmt::format(format, std::forward<Args>(args)...));
}

template <class... Args>
void log_warning(fmt::format_string<Args...> format, Args&&... args) {
    log_line(LogLevel::warning, fmt::format(format, std::forward<Args>(args)...));
}

template <class... Args>
void log_error(fmt::format_string<Args...> format, Args&&... args) {
    log_line(LogLevel::error, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace touchstone
