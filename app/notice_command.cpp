#include "app/notice_command.hpp"

#include <chrono>
#include <thread>

#include "app/displays.hpp"
#include "platform/system/failure_note.hpp"
#include "platform/system/log.hpp"
#include "platform/system/termination_signals.hpp"
#include "ui/calibration_screen.hpp"

namespace touchstone {

ExitStatus notice_command(const NoticeOptions& options) {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds between_looks{200};
    TerminationSignals signals;
    const std::string reason = kept_failure();
    const std::string words = reason.empty() ? options.words : options.words + "\n\n" + reason;
    log_info("showing: {}", words);
    ThrownPicture picture;
    picture.words = words;
    const auto display =
        open_display(choose_display(options.display), options.config.display, WindowPixels::shown_only);
    CalibrationScreen screen(*display);
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(options.seconds));
    while (!signals.arrived() && !display->should_close() && Clock::now() < end) {
        screen.draw(picture);
        display->present();
        std::this_thread::sleep_for(between_looks);
    }
    return ExitStatus::ok;
}

}  // namespace touchstone
