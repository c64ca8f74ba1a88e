#include <cstdio>
#include <exception>

#include "app/bench_command.hpp"
#include "app/calibrate_command.hpp"
#include "app/check_command.hpp"
#include "app/command_line.hpp"
#include "app/notice_command.hpp"
#include "app/record_command.hpp"
#include "app/reset_command.hpp"
#include "app/run_command.hpp"
#include "app/scan_command.hpp"
#include "app/track_command.hpp"
#include "platform/system/error.hpp"
#include "platform/system/failure_note.hpp"
#include "platform/system/one_line.hpp"

namespace {

touchstone::ExitStatus execute(const touchstone::Command& command) {
    if (const auto* printed = std::get_if<touchstone::PrintedText>(&command)) {
        std::fputs(printed->text.c_str(), stdout);
        return touchstone::ExitStatus::ok;
    }
    if (const auto* scan = std::get_if<touchstone::ScanOptions>(&command))
        return touchstone::scan_command(*scan);
    if (const auto* track = std::get_if<touchstone::TrackOptions>(&command))
        return touchstone::track_command(*track);
    if (const auto* calibrate = std::get_if<touchstone::CalibrateOptions>(&command))
        return touchstone::calibrate_command(*calibrate);
    if (const auto* record = std::get_if<touchstone::RecordOptions>(&command))
        return touchstone::record_command(*record);
    if (const auto* bench = std::get_if<touchstone::BenchOptions>(&command))
        return touchstone::bench_command(*bench);
    if (const auto* check = std::get_if<touchstone::CheckOptions>(&command))
        return touchstone::check_command(*check);
    if (const auto* notice = std::get_if<touchstone::NoticeOptions>(&command))
        return touchstone::notice_command(*notice);
    if (const auto* reset = std::get_if<touchstone::ResetOptions>(&command))
        return touchstone::reset_command(*reset);
    return touchstone::run_command(std::get<touchstone::RunOptions>(command));
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return static_cast<int>(execute(touchstone::parse_command_line(argc, argv)));
    } catch (const touchstone::Error& error) {
        touchstone::keep_failure(error.what());
        std::fprintf(stderr, "touchstone: %s\n", touchstone::one_line(error.what()).c_str());
        return static_cast<int>(error.status());
    } catch (const std::exception& error) {
        touchstone::keep_failure(error.what());
        std::fprintf(stderr, "touchstone: unexpected: %s\n", error.what());
        return static_cast<int>(touchstone::ExitStatus::unavailable);
    }
}
