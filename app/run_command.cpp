#include "app/run_command.hpp"

#include <exception>
#include <thread>

#include "app/perception.hpp"
#include "app/presentation.hpp"
#include "platform/system/log.hpp"
#include "platform/system/mailbox.hpp"
#include "platform/system/termination_signals.hpp"

namespace touchstone {

namespace {

/// Step pace: one thread, every frame is shown.
void run_in_lock_step(Perception& perception, Presentation& presentation, TerminationSignals& signals) {
    while (!signals.arrived() && !presentation.should_close()) {
        const std::optional<TableFrame> frame = perception.step();
        if (!frame) return;
        presentation.show(*frame);
        perception.take(presentation.wish());
    }
}

/// Live pace: perception has a thread of its own and never waits for the screen.
void run_two_loops(Perception& perception, Presentation& presentation, TerminationSignals& signals) {
    Mailbox<TableFrame> mailbox(merge_frames);
    Mailbox<SceneWish> wishes;
    std::exception_ptr failure;
    std::jthread perceiving([&](const std::stop_token& stop) {
        try {
            while (!stop.stop_requested()) {
                if (std::optional<SceneWish> wish = wishes.try_take()) perception.take(std::move(*wish));
                std::optional<TableFrame> frame = perception.step();
                if (!frame) break;
                mailbox.put(std::move(*frame));
            }
        } catch (...) {
            failure = std::current_exception();
        }
        mailbox.close();
    });
    constexpr std::chrono::milliseconds between_looks{15};
    TableFrame latest;
    while (!signals.arrived() && !presentation.should_close()) {
        std::optional<TableFrame> next = mailbox.take_for(between_looks);
        if (!next && mailbox.closed()) break;
        if (next) latest = std::move(*next);
        if (!next && !presentation.animates()) continue;
        presentation.show(latest);
        wishes.put(presentation.wish());
    }
    perceiving.request_stop();
    perceiving.join();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace

ExitStatus run_command(const RunOptions& options) {
    set_log_level(log_level(options.config));
    TerminationSignals signals;
    Perception perception(options);
    Presentation presentation(options);
    if (perception.in_lock_step())
        run_in_lock_step(perception, presentation, signals);
    else
        run_two_loops(perception, presentation, signals);
    return ExitStatus::ok;
}

}  // namespace touchstone
