#include "app/run_command.hpp"

#include "app/perception.hpp"
#include "app/presentation.hpp"
#include "app/two_loops.hpp"
#include "platform/system/failure_note.hpp"
#include "platform/system/log.hpp"
#include "platform/system/termination_signals.hpp"

namespace touchstone {

namespace {

/// Step pace: one thread, every frame is shown.
void run_in_lock_step(Perception& perception, Presentation& presentation, TerminationSignals& signals,
                      ServiceWatch& watch) {
    while (!signals.arrived() && !presentation.should_close()) {
        const std::optional<TableFrame> frame = perception.step();
        if (!frame) return;
        watch.perceived(*frame);
        presentation.draw(*frame);
        presentation.show();
        watch.presented();
        perception.take(presentation.wish());
        perception.follow();
    }
}

}  // namespace

ExitStatus run_command(const RunOptions& options) {
    set_log_level(log_level(options.config));
    forget_failure();
    TerminationSignals signals;
    ServiceWatch watch;
    Perception perception(options);
    Presentation presentation(options);
    if (perception.in_lock_step())
        run_in_lock_step(perception, presentation, signals, watch);
    else
        run_two_loops(perception, presentation, signals, watch);
    log_info("ended after {} frames and {} touches", perception.figures().frames,
             perception.figures().touches);
    return ExitStatus::ok;
}

}  // namespace touchstone
