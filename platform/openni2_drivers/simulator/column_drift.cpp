#include "platform/openni2_drivers/simulator/column_drift.hpp"

#include <algorithm>

#include "platform/openni2_drivers/simulator/geometry.hpp"

namespace touchstone::sim {
namespace {

constexpr double change_length_s = 100.0 / 30.0;
constexpr float most_steps = 2.0F;

}  // namespace

ColumnDrift::ColumnDrift(std::uint64_t seed, int width_px)
    : random_(seed, 0xd41f7), columns_(static_cast<std::size_t>(width_px), 0.0F) {
    int band = 0;
    for (int x = 0; x < width_px; ++band) {
        const int end = std::min(width_px, x + 40 + random_.below(60));
        for (; x < end; ++x) band_of_column_.push_back(band);
    }
    from_.assign(static_cast<std::size_t>(band), 0.0F);
    to_ = from_;
    for (float& steps : to_) steps = random_.uniform(-most_steps, most_steps);
    change_s_ = random_.uniform(6.0F, 15.0F);
}

const std::vector<float>& ColumnDrift::at(double time_s) {
    while (time_s >= change_s_ + change_length_s) {
        from_ = to_;
        for (float& steps : to_)
            steps = std::clamp(steps + random_.uniform(-1.5F, 1.5F), -most_steps, most_steps);
        change_s_ += change_length_s + static_cast<double>(random_.uniform(8.0F, 25.0F));
    }
    const float share =
        minimum_jerk(static_cast<float>(std::clamp((time_s - change_s_) / change_length_s, 0.0, 1.0)));
    for (std::size_t x = 0; x < columns_.size(); ++x) {
        const auto band = static_cast<std::size_t>(band_of_column_[x]);
        columns_[x] = from_[band] + share * (to_[band] - from_[band]);
    }
    return columns_;
}

}  // namespace touchstone::sim
