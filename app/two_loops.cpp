#include "app/two_loops.hpp"

#include <exception>
#include <thread>

#include "platform/system/mailbox.hpp"

namespace touchstone {

void run_two_loops(Perception& perception, Presentation& presentation, TerminationSignals& signals,
                   ServiceWatch& watch) {
    Mailbox<TableFrame> mailbox(merge_frames);
    Mailbox<TableWish> wishes;
    std::exception_ptr failure;
    std::jthread perceiving([&](const std::stop_token& stop) {
        try {
            while (!stop.stop_requested()) {
                if (std::optional<TableWish> wish = wishes.try_take()) perception.take(std::move(*wish));
                std::optional<TableFrame> frame = perception.step();
                if (!frame) break;
                watch.perceived(*frame);
                mailbox.put(std::move(*frame));
                perception.follow();
            }
        } catch (...) {
            failure = std::current_exception();
        }
        mailbox.close();
    });
    constexpr std::chrono::milliseconds between_looks{15};
    TableFrame latest;
    while (!signals.arrived() && !presentation.should_close()) {
        watch.presented();
        std::optional<TableFrame> next = mailbox.take_for(between_looks);
        if (!next && mailbox.closed()) break;
        if (next) latest = std::move(*next);
        if (!next && !presentation.animates()) continue;
        presentation.draw(latest);
        wishes.put(presentation.wish());
        presentation.show();
    }
    watch.stopping();
    perceiving.request_stop();
    perceiving.join();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace touchstone
