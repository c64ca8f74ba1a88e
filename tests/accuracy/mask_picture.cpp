#include "tests/accuracy/mask_picture.hpp"

#include <algorithm>
#include <array>

namespace touchstone {

Image8 mask_picture(const Image16& depth_mm, std::span<const std::uint8_t> truth,
                    std::span<const std::uint8_t> mask, std::span<const std::uint8_t> counted) {
    const int farthest_mm = std::max<int>(1, *std::ranges::max_element(depth_mm.pixels));
    Image8 picture{depth_mm.width_px, depth_mm.height_px, 3, {}};
    picture.pixels.reserve(3 * depth_mm.pixels.size());
    for (std::size_t i = 0; i < depth_mm.pixels.size(); ++i) {
        const int mm = depth_mm.pixels[i];
        const int gray = mm == 0 ? 0 : 230 - 160 * mm / farthest_mm;
        std::array rgb{gray, gray, gray};
        if (counted[i] != 0 && (truth[i] != 0 || mask[i] != 0)) {
            const std::size_t channel = truth[i] == 0 ? 0 : mask[i] == 0 ? 2 : 1;
            for (std::size_t c = 0; c < rgb.size(); ++c) rgb[c] = c == channel ? 255 : gray / 2;
        }
        for (const int value : rgb) picture.pixels.push_back(static_cast<std::uint8_t>(value));
    }
    return picture;
}

}  // namespace touchstone
