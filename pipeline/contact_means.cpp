#include "pipeline/contact_means.hpp"

#include <algorithm>

namespace touchstone {

using Eigen::Vector3f;

std::vector<EndedContact> ContactMeans::take(std::span<const TouchEvent> touches) {
    std::vector<EndedContact> ended;
    for (const TouchEvent& event : touches) {
        if (event.phase != TouchPhase::up) {
            if (event.tip.state != FingerState::hidden) follow(event.tip);
            continue;
        }
        const auto at = std::ranges::find(contacts_, event.tip.id, &Contact::id);
        if (at == contacts_.end()) continue;
        ended.push_back({{at->sum.surface_c_m / static_cast<float>(at->frames), at->sum.normal_c.normalized(),
                          at->sum.axis_c.normalized()},
                         at->drag_m});
        contacts_.erase(at);
    }
    return ended;
}

void ContactMeans::follow(const Fingertip& tip) {
    auto at = std::ranges::find(contacts_, tip.id, &Contact::id);
    if (at == contacts_.end()) {
        Contact contact;
        contact.id = tip.id;
        contact.sum = {Vector3f::Zero(), Vector3f::Zero(), Vector3f::Zero()};
        contact.first_c_m = tip.surface_c_m;
        at = contacts_.insert(contacts_.end(), contact);
    }
    ++at->frames;
    at->sum.surface_c_m += tip.surface_c_m;
    at->sum.normal_c += tip.normal_c;
    at->sum.axis_c += tip.axis_c;
    at->drag_m = std::max(at->drag_m, (tip.surface_c_m - at->first_c_m).norm());
}

}  // namespace touchstone
