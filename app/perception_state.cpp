// What the perception loop keeps on the disk for the next start. A disk that is full, read-only or damaged
// costs what it would have kept, never the table.
#include "app/perception.hpp"
#include "platform/system/log.hpp"

namespace touchstone {
namespace {

constexpr std::chrono::seconds between_tries{60};

}  // namespace

bool Perception::keep(const std::string& what, const std::string& otherwise,
                      const std::function<void()>& write) {
    try {
        write();
        if (unsaved_.saved(what)) log_info("the {} is kept again", what);
        return true;
    } catch (const Error& error) {
        if (note_unsaved(what, error.what()))
            log_warning("the {} is not kept: {}; {}", what, error.what(), otherwise);
        return false;
    }
}

bool Perception::note_unsaved(const std::string& what, const std::string& reason) {
    const bool is_news = unsaved_.failed(what, reason);
    if (is_news) {
        health_.unsaved(what);
        desk_.note_fault("disk", "the " + what + " is not kept: " + reason);
    }
    return is_news;
}

void Perception::take_unsaved(const std::string& what, const std::string& reason) {
    if (reason.empty())
        unsaved_.saved(what);
    else
        note_unsaved(what, reason);
}

void Perception::save_scan_when_new(InteractionState state) {
    if (state == InteractionState::scanning || state == InteractionState::realigning) scan_is_new_ = true;
    if (state != InteractionState::live || !scan_is_new_ || options_.config.scan_file.empty()) return;
    const auto now = std::chrono::steady_clock::now();
    if (now < next_scan_save_) return;
    scan_is_new_ = !keep("scan", "the next start scans anew", [this] {
        save_scan(options_.config.scan_file, pipeline_->saved_scan());
        log_info("scan written: {}", options_.config.scan_file);
    });
    if (scan_is_new_) next_scan_save_ = now + between_tries;
}

}  // namespace touchstone
