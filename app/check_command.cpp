#include "app/check_command.hpp"

#include <cstdio>
#include <utility>

#include "app/check_report.hpp"
#include "app/configuration_checks.hpp"
#include "app/machine_checks.hpp"
#include "app/progress_line.hpp"
#include "app/sensor_checks.hpp"
#include "platform/display/sdl_outputs.hpp"
#include "platform/opencl/device.hpp"
#include "platform/system/log.hpp"

namespace touchstone {
namespace {

void append(std::vector<CheckLine>& lines, std::vector<CheckLine> more) {
    for (CheckLine& line : more) lines.push_back(std::move(line));
}

std::vector<CheckLine> check_source(const CheckLine& configuration, const Config& config) {
    if (configuration.status == CheckStatus::fail)
        return {{"sensor", CheckStatus::warn, "not looked for: the configuration may name one",
                 "mend the configuration first"}};
    std::vector<CheckLine> lines = check_named_source(config);
    return lines.empty() ? check_sensors() : lines;
}

std::vector<CheckLine> check_all(const CheckOptions& options) {
    ProgressLine progress;
    Config config;
    progress.show("checking configuration and sensors");
    const CheckLine configuration = check_configuration(options.config_file, config);
    std::vector<CheckLine> lines = check_source(configuration, config);
    progress.show("checking and measuring OpenCL devices");
    append(lines, check_compute(config));
    lines.push_back(check_drawing());
    append(lines, output_lines(list_outputs()));
    if (config.touch_screen_enabled) lines.push_back(check_uinput());
    lines.push_back(check_service());
    lines.push_back(check_disk(default_cache_dir()));
    std::vector<CheckLine> named = check_named_files(config);
    if (named.empty() || configuration.status == CheckStatus::fail) named.push_back(configuration);
    append(lines, std::move(named));
    return lines;
}

}  // namespace

ExitStatus check_command(const CheckOptions& options) {
    set_log_level(LogLevel::error);
    const std::vector<CheckLine> lines = check_all(options);
    std::fputs((options.json ? check_json(lines) : check_text(lines)).c_str(), stdout);
    return check_exit_status(lines);
}

}  // namespace touchstone
