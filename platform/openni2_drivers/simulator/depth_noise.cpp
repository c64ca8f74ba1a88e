#include "platform/openni2_drivers/simulator/depth_noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace touchstone::sim {
namespace {

constexpr int width_px = 640;
constexpr int height_px = 480;
constexpr int lost_columns = 8;  ///< of the right border: the Kinect's matching window ends there
constexpr float baseline_m = 0.075F;
constexpr float steps_per_px = 8.0F;
/// With the spread of the 1/8 px steps, 0.036 px, this gives 1.35 mm at 1 m and 5.4 mm at 2 m.
constexpr float sigma_px = 0.0455F;
constexpr float nearest_m = 0.4F;
constexpr float farthest_m = 10.0F;

constexpr int table_side = 512;
constexpr int table_stride =
    table_side + width_px;  ///< rows are repeated, so that a picture's row never wraps
constexpr std::size_t max_step = 1023;

constexpr std::uint8_t edge_flag = 1;
constexpr std::uint8_t grazing_flag = 2;
constexpr float grazing_tangent = 3.2F;  ///< of the angle between the ray and the normal: 73 degrees

std::size_t at(int x, int y) { return static_cast<std::size_t>(y * width_px + x); }

/// 0 where nothing is seen, or it is too far for the number.
std::uint16_t whole_mm(float mm) {
    return mm >= 0.0F && mm < 65535.0F ? static_cast<std::uint16_t>(mm + 0.5F) : std::uint16_t{0};
}

/// White noise, blurred by a binomial of 5 x 5 taps on a torus, scaled to unit variance.
std::vector<float> make_noise_table(std::uint64_t seed) {
    constexpr std::size_t count = std::size_t{table_side} * table_side;
    Random random(seed, 0x401e);
    std::vector<float> white(count);
    for (float& value : white) value = random.normal();
    const auto blurred = [](const std::vector<float>& in, std::size_t step, std::size_t period) {
        std::vector<float> out(in.size());
        for (std::size_t i = 0; i < in.size(); ++i) {
            const std::size_t base = i / period * period;
            const auto tap = [&](std::size_t k) { return in[base + (i - base + k * step) % period]; };
            out[i] = (tap(0) + tap(4)) + 4.0F * (tap(1) + tap(3)) + 6.0F * tap(2);
        }
        return out;
    };
    const std::vector<float> smooth = blurred(blurred(white, 1, table_side), table_side, count);
    constexpr float gain = 1.0F / 70.0F;  // the sum of the squared taps is 70 in each direction
    std::vector<float> table(std::size_t{table_side} * table_stride);
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i] = gain * smooth[i / table_stride * table_side + i % table_stride % table_side];
    return table;
}

std::vector<std::uint16_t> make_depth_of_step(float disparity_m_px) {
    std::vector<std::uint16_t> mm_of_step(max_step + 1, 0);
    for (std::size_t step = 1; step <= max_step; ++step) {
        const float z_m = disparity_m_px * steps_per_px / static_cast<float>(step);
        if (z_m >= nearest_m && z_m <= farthest_m)
            mm_of_step[step] = static_cast<std::uint16_t>(std::lround(1000.0F * z_m));
    }
    return mm_of_step;
}

/// About normal, sigma 1, from 32 random bits.
int jitter_px(std::uint64_t bits) {
    int sum = 0;
    for (int i = 0; i < 4; ++i) sum += static_cast<int>(bits >> (8 * i) & 0xff);
    return static_cast<int>(std::lround(static_cast<float>(sum - 510) / 148.0F));
}

/// Calls visit(i) for each pixel with the flag; most pixels have none, so it looks at eight at a time.
template <class Visit>
void for_each_flagged(const std::vector<std::uint8_t>& flags, std::uint8_t flag, Visit visit) {
    for (std::size_t i = 0; i + 8 <= flags.size(); i += 8) {
        std::uint64_t eight;
        std::memcpy(&eight, flags.data() + i, 8);
        if (eight == 0) continue;
        for (std::size_t k = i; k < i + 8; ++k)
            if ((flags[k] & flag) != 0) visit(k);
    }
}

}  // namespace

DepthNoise::DepthNoise(std::uint64_t seed, float focal_px, bool noise, bool drift)
    : seed_(mix64(seed)),
      disparity_m_px_(focal_px * baseline_m),
      noise_(noise),
      drift_(seed, width_px),
      drifts_(drift),
      disparity_(at(0, height_px)),
      edge_(at(0, height_px), 0),
      noise_table_(make_noise_table(seed)),
      mm_of_step_(make_depth_of_step(disparity_m_px_)) {}

void DepthNoise::apply(const std::vector<float>& depth_m, int frame, double time_s,
                       std::vector<std::uint16_t>& depth_mm) {
    depth_mm.resize(depth_m.size());
    if (!noise_ && !drifts_) {
        for (std::size_t i = 0; i < depth_m.size(); ++i) depth_mm[i] = whole_mm(1000.0F * depth_m[i]);
        return;
    }
    find_disparity(depth_m);
    if (!noise_) {
        only_drift(time_s, depth_mm);
        return;
    }
    find_edges();
    cast_shadows();
    jitter_edges(frame);
    drop_grazing(frame);
    quantise(frame, time_s, depth_mm);
    add_specks(frame, depth_mm);
}

void DepthNoise::find_disparity(const std::vector<float>& depth_m) {
    for (std::size_t i = 0; i < depth_m.size(); ++i) disparity_[i] = disparity_m_px_ / depth_m[i];
}

void DepthNoise::find_edges() {
    // The tangent is focal length times slope over disparity.
    const float grazing = grazing_tangent * baseline_m / disparity_m_px_;
    for (int y = 2; y < height_px - 2; ++y) {
        const float* here = disparity_.data() + at(0, y);
        std::uint8_t* flags = edge_.data() + at(0, y);
        for (int x = 2; x < width_px - 2; ++x) {
            const float* d = here + x;
            const float slope_x = std::min(std::abs(d[0] - d[-1]), std::abs(d[1] - d[0]));
            const float slope_y = std::min(std::abs(d[0] - d[-width_px]), std::abs(d[width_px] - d[0]));
            const float slope = std::max(slope_x, slope_y);
            const float step_x = std::max(std::abs(d[-2] - d[0]), std::abs(d[2] - d[0]));
            const float step_y =
                std::max(std::abs(d[-2 * width_px] - d[0]), std::abs(d[2 * width_px] - d[0]));
            const bool edge = std::max(step_x, step_y) > std::max(0.3F, 4.0F * slope);
            flags[x] = static_cast<std::uint8_t>((edge ? edge_flag : 0) |
                                                 (slope > grazing * d[0] ? grazing_flag : 0));
        }
    }
}

void DepthNoise::cast_shadows() {
    // The projector stands at +x of the camera: pixel u is lit along projector column u - disparity. What is
    // nearer and further right but has a smaller column stands in this pixel's light.
    for (int y = 0; y < height_px; ++y) {
        float* row = disparity_.data() + at(0, y);
        float least_column = static_cast<float>(2 * width_px);
        for (int x = width_px - 1; x >= 0; --x) {
            const float column = static_cast<float>(x) - row[x];
            row[x] = column >= least_column ? 0.0F : row[x];
            least_column = std::min(least_column, column);
        }
    }
}

void DepthNoise::jitter_edges(int frame) {
    moved_.clear();
    for_each_flagged(edge_, edge_flag, [&](std::size_t i) {
        const int x = static_cast<int>(i) % width_px;
        const int y = static_cast<int>(i) / width_px;
        // Blocks of 2 x 2 pixels move together: the matching windows of neighbours overlap.
        const auto block = static_cast<std::uint64_t>((y / 2) * width_px + x / 2);
        const std::uint64_t bits = mix64(seed_ ^ (static_cast<std::uint64_t>(frame) << 32) ^ block);
        const int from_x = std::clamp(x + jitter_px(bits), 0, width_px - 1);
        const int from_y = std::clamp(y + jitter_px(bits >> 32), 0, height_px - 1);
        moved_.push_back({static_cast<std::uint32_t>(i), disparity_[at(from_x, from_y)]});
    });
    for (const Moved& moved : moved_) disparity_[moved.pixel] = moved.disparity_px;
}

void DepthNoise::drop_grazing(int frame) {
    const std::uint64_t salt = mix64(seed_ + 0x9a2 + static_cast<std::uint64_t>(frame));
    for_each_flagged(edge_, grazing_flag, [&](std::size_t i) {
        // 3 of 4 readings are lost where the surface is that steep.
        if ((mix64(salt ^ i) & 3) != 0) disparity_[i] = 0.0F;
    });
}

void DepthNoise::quantise(int frame, double time_s, std::vector<std::uint16_t>& depth_mm) {
    Random random(seed_, static_cast<std::uint64_t>(frame));
    const int shift_x[2] = {random.below(table_side), random.below(table_side)};
    const int shift_y[2] = {random.below(table_side), random.below(table_side)};
    const float gain = sigma_px * steps_per_px * std::sqrt(0.5F);
    static constexpr int no_reading = 0;
    column_steps_.assign(width_px, 0.5F);  // rounds
    if (drifts_) {
        const std::vector<float>& drift = drift_.at(time_s);
        for (std::size_t x = 0; x < column_steps_.size(); ++x) column_steps_[x] += drift[x];
    }
    for (int y = 0; y < height_px; ++y) {
        const auto table_row = [&](int k) {
            return noise_table_.data() + ((y + shift_y[k]) % table_side) * table_stride + shift_x[k];
        };
        const float* one = table_row(0);
        const float* two = table_row(1);
        const float* row = disparity_.data() + at(0, y);
        std::uint16_t* out = depth_mm.data() + at(0, y);
        int steps[width_px];
        for (int x = 0; x < width_px; ++x) {
            const float exact =
                steps_per_px * row[x] + gain * (one[x] + two[x]) + column_steps_[static_cast<std::size_t>(x)];
            const int step = static_cast<int>(std::min(exact, static_cast<float>(max_step)));
            steps[x] = row[x] > 0.0F ? std::max(step, 0) : no_reading;
        }
        for (int x = 0; x < width_px - lost_columns; ++x)
            out[x] = mm_of_step_[static_cast<std::size_t>(steps[x])];
        std::fill(out + width_px - lost_columns, out + width_px, std::uint16_t{0});
    }
}

void DepthNoise::add_specks(int frame, std::vector<std::uint16_t>& depth_mm) const {
    Random random(seed_ + 0x57ec, static_cast<std::uint64_t>(frame));
    const int count = random.below(40);
    for (int i = 0; i < count; ++i) {
        const int left = random.below(width_px - 4);
        const int top = random.below(height_px - 4);
        const int wide = 1 + random.below(3);
        const int high = 1 + random.below(3);
        for (int y = top; y < top + high; ++y)
            for (int x = left; x < left + wide; ++x) depth_mm[at(x, y)] = 0;
    }
}

void DepthNoise::only_drift(double time_s, std::vector<std::uint16_t>& depth_mm) {
    const std::vector<float>& drift = drift_.at(time_s);
    for (std::size_t i = 0; i < depth_mm.size(); ++i) {
        const float disparity = disparity_[i] + drift[i % width_px] / steps_per_px;
        depth_mm[i] = whole_mm(1000.0F * disparity_m_px_ / disparity);
    }
}

}  // namespace touchstone::sim
