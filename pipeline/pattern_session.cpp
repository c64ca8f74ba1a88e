#include "pipeline/pattern_session.hpp"

#include <algorithm>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

/// Of the three channels alike: what colour the light of a projector has is not known.
std::vector<float> gray_of(std::span<const std::uint8_t> rgb) {
    std::vector<float> gray(rgb.size() / 3);
    for (std::size_t i = 0; i < gray.size(); ++i)
        gray[i] = static_cast<float>(rgb[3 * i] + rgb[3 * i + 1] + rgb[3 * i + 2]) / 3.0f;
    return gray;
}

}  // namespace

std::optional<int> PatternSession::pattern() const {
    if (is_over_) return std::nullopt;
    return std::min(static_cast<int>(seen_.size()), patterns_ - 1);
}

void PatternSession::take(std::span<const std::uint8_t> rgb, bool disturbed) {
    if (!pattern()) return;
    if (disturbed) {
        if (quiet_ == 0) begin_again();
        quiet_ = config_.quiet_frames;
        return;
    }
    if (quiet_ > 0) {
        --quiet_;
        return;
    }
    if (static_cast<int>(seen_.size()) == patterns_) {
        is_over_ = true;
        return;
    }
    if (wait_ > 0) {
        --wait_;
        return;
    }
    const std::vector<float> gray = gray_of(rgb);
    const std::size_t pixels = seen_.empty() ? gray.size() : seen_.front().size();
    if (gray.size() != pixels || (frames_ > 0 && gray.size() != sum_.size()))
        throw Error(ExitStatus::bad_data, "the camera's colour pictures change their size: use one size");
    if (frames_ == 0) sum_.assign(gray.size(), 0.0f);
    for (std::size_t i = 0; i < gray.size(); ++i) sum_[i] += gray[i];
    if (++frames_ < config_.frames_per_pattern) return;
    for (float& value : sum_) value /= static_cast<float>(frames_);
    seen_.push_back(std::move(sum_));
    frames_ = 0;
    wait_ = config_.settle_frames;
}

void PatternSession::begin_again() {
    if (++disturbances_ > config_.most_disturbances)
        throw Error(ExitStatus::bad_data,
                    "something moves in the view all the time: keep away from the table, and try again");
    if (!seen_.empty()) seen_.pop_back();
    frames_ = 0;
    wait_ = config_.settle_frames;
}

}  // namespace touchstone
