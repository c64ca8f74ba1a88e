#include "pipeline/bulkiest_place.hpp"

#include <algorithm>
#include <vector>

namespace touchstone {

namespace {

/// Steps to a neighbour and across a corner, in thirds of a cell.
constexpr int straight = 3, across = 4;
/// A long thing is as bulky all along its middle: the mean of what is about as far from the border.
constexpr float ridge_share = 0.75f;
constexpr int ridge_radii = 3;

class Chamfer {
  public:
    Chamfer(std::span<const std::uint8_t> mask, int width, int height)
        : width_(width), height_(height), thirds_(mask.size()) {
        for (std::size_t i = 0; i < mask.size(); ++i) thirds_[i] = mask[i] == 0 ? 0 : far;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) relax(x, y, -1);
        for (int y = height - 1; y >= 0; --y)
            for (int x = width - 1; x >= 0; --x) relax(x, y, 1);
    }
    int at(int x, int y) const {
        const bool inside = x >= 0 && y >= 0 && x < width_ && y < height_;
        return inside ? thirds_[static_cast<std::size_t>(y * width_ + x)] : 0;
    }

  private:
    static constexpr int far = 1 << 20;

    /// From the four neighbours that come before (sign -1) or after (1) in the order of reading.
    void relax(int x, int y, int sign) {
        int& here = thirds_[static_cast<std::size_t>(y * width_ + x)];
        here = std::min({here, at(x + sign, y) + straight, at(x, y + sign) + straight,
                         at(x + sign, y + sign) + across, at(x - sign, y + sign) + across});
    }

    int width_, height_;
    std::vector<int> thirds_;
};

}  // namespace

GridPlace bulkiest_place(std::span<const std::uint8_t> mask, int width, int height) {
    const Chamfer distance(mask, width, height);
    int most = 0, peak_x = -1, peak_y = -1;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (distance.at(x, y) <= most) continue;
            most = distance.at(x, y);
            peak_x = x, peak_y = y;
        }
    }
    if (most == 0) return {};
    const int reach = ridge_radii * most / straight + 1;
    int count = 0, sum_x = 0, sum_y = 0;
    for (int y = peak_y - reach; y <= peak_y + reach; ++y) {
        for (int x = peak_x - reach; x <= peak_x + reach; ++x) {
            if (static_cast<float>(distance.at(x, y)) < ridge_share * static_cast<float>(most)) continue;
            ++count, sum_x += x, sum_y += y;
        }
    }
    return {sum_x / count, sum_y / count, static_cast<float>(most) / static_cast<float>(straight)};
}

}  // namespace touchstone
