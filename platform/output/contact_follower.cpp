#include "platform/output/contact_follower.hpp"

#include <limits>

namespace touchstone {
namespace {

std::int32_t number_after(std::int32_t number) {
    return number == std::numeric_limits<std::int32_t>::max() ? 1 : number + 1;
}

}  // namespace

std::vector<ContactChange> ContactFollower::take(const std::vector<ReportedFinger>& touches) {
    std::vector<ContactChange> changes;
    for (auto& [id, contact] : contacts_) contact.seen = false;
    for (const ReportedFinger& touch : touches) {
        const auto known = contacts_.find(touch.id);
        if (known != contacts_.end() && touch.phase == ReportedPhase::move) {
            known->second.seen = true;
            changes.push_back({ContactStep::move, known->second.number, touch});
            continue;
        }
        if (known != contacts_.end()) {
            changes.push_back({ContactStep::end, known->second.number, {}});
            contacts_.erase(known);
        }
        if (touch.phase == ReportedPhase::up) continue;
        changes.push_back({ContactStep::begin, next_, touch});
        contacts_[touch.id] = {next_, true};
        next_ = number_after(next_);
    }
    std::erase_if(contacts_, [&](const auto& entry) {
        if (!entry.second.seen) changes.push_back({ContactStep::end, entry.second.number, {}});
        return !entry.second.seen;
    });
    return changes;
}

std::vector<ContactChange> ContactFollower::end_all() { return take({}); }

}  // namespace touchstone
