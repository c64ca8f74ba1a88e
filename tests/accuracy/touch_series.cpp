#include "tests/accuracy/touch_series.hpp"

#include <algorithm>

namespace touchstone {

void TouchSeries::append(const TouchTruth& truth, const TouchLog& log) {
    const int first_frame = static_cast<int>(truth_.tips.size());
    const int first_id = next_id_;
    truth_.fps = truth.fps;
    truth_.tips.insert(truth_.tips.end(), truth.tips.begin(), truth.tips.end());
    for (const auto& [frame, touches] : log) {
        auto& moved = log_[first_frame + frame];
        for (const LoggedTouch& touch : touches) {
            moved.push_back({first_id + touch.id, touch.camera_mm});
            next_id_ = std::max(next_id_, first_id + touch.id + 1);
        }
    }
}

}  // namespace touchstone
