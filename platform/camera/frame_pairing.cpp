#include "platform/camera/frame_pairing.hpp"

#include <algorithm>
#include <utility>

namespace touchstone {
namespace {

constexpr std::uint64_t tolerance_us = 50'000;
constexpr std::size_t most_waiting = 4, most_colors = 8;

std::uint64_t distance_us(std::uint64_t a, std::uint64_t b) { return a > b ? a - b : b - a; }

}  // namespace

void FramePairing::add(ColorPicture picture) {
    colors_.push_back(std::move(picture));
    if (colors_.size() > most_colors) colors_.pop_front();
}

std::optional<DepthFrame> FramePairing::take() {
    if (depths_.empty()) return std::nullopt;
    const std::uint64_t time_us = depths_.front().timestamp_us;
    const bool color_is_there = !colors_.empty() && colors_.back().timestamp_us >= time_us;
    if (wait_for_color_ && !color_is_there && depths_.size() < most_waiting) return std::nullopt;
    DepthFrame frame = std::move(depths_.front());
    depths_.pop_front();
    // On a tie the newest wins: a source may repeat a time when it starts over.
    const auto nearest =
        std::min_element(colors_.rbegin(), colors_.rend(), [&](const auto& a, const auto& b) {
            return distance_us(a.timestamp_us, time_us) < distance_us(b.timestamp_us, time_us);
        });
    if (nearest != colors_.rend() && distance_us(nearest->timestamp_us, time_us) <= tolerance_us) {
        frame.color_rgb = scale_nearest(*nearest, frame.width_px, frame.height_px);
    }
    return frame;
}

std::vector<std::uint8_t> scale_nearest(const ColorPicture& picture, int width_px, int height_px) {
    if (picture.rgb.empty() || (picture.width_px == width_px && picture.height_px == height_px))
        return picture.rgb;
    std::vector<std::uint8_t> scaled(3 * static_cast<std::size_t>(width_px) *
                                     static_cast<std::size_t>(height_px));
    auto out = scaled.begin();
    for (int y = 0; y < height_px; ++y) {
        const int from_y = (2 * y + 1) * picture.height_px / (2 * height_px);
        for (int x = 0; x < width_px; ++x) {
            const int from_x = (2 * x + 1) * picture.width_px / (2 * width_px);
            const auto pixel = picture.rgb.begin() + 3 * (from_y * picture.width_px + from_x);
            out = std::copy(pixel, pixel + 3, out);
        }
    }
    return scaled;
}

}  // namespace touchstone
