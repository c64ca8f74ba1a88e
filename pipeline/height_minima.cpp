#include "pipeline/height_minima.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace touchstone {

namespace {

constexpr float levels_per_m = 1000.0f;

/// What is known at the root of a basin.
struct Basin {
    int pixels = 0;
    int birth = 0;   ///< level of its lowest pixel
    int lowest = 0;  ///< that pixel
};

/// Union-find over pixels flooded in order of height. Pixels are those of the picture with a border of one
/// around it, so that every pixel has eight neighbours.
class Flood {
  public:
    Flood(std::size_t pixels, int stride_px, const HeightMinimaConfig& config)
        : parents_(pixels, dry),
          basins_(pixels),
          neighbours_{-stride_px - 1, -stride_px, -stride_px + 1, -1, 1,
                      stride_px - 1,  stride_px,  stride_px + 1},
          config_(config) {}

    void add(int pixel, int level) {
        parent(pixel) = pixel;
        basin(pixel) = {1, level, pixel};
        int mine = pixel;
        for (const int offset : neighbours_) {
            const int next = parent(pixel + offset);
            if (next == dry || next == mine) continue;
            const int other = root(next);
            if (other != mine) mine = join(mine, other, level);
        }
    }

    HeightMinima result() {
        HeightMinima found;
        std::vector<int> object(parents_.size(), -1);
        for (int pixel = 0; pixel < static_cast<int>(parents_.size()); ++pixel) {
            if (parent(pixel) != pixel) continue;
            object[static_cast<std::size_t>(pixel)] = static_cast<int>(found.object_pixels.size());
            found.object_pixels.push_back(basin(pixel).pixels);
            report(pixel);
        }
        for (const int minimum : minima_)
            found.minima.push_back({minimum, object[static_cast<std::size_t>(root(minimum))]});
        return found;
    }

  private:
    static constexpr int dry = -1;

    int& parent(int pixel) { return parents_[static_cast<std::size_t>(pixel)]; }
    Basin& basin(int pixel) { return basins_[static_cast<std::size_t>(pixel)]; }

    int root(int pixel) {
        while (parent(pixel) != pixel) pixel = parent(pixel) = parent(parent(pixel));
        return pixel;
    }

    /// Of two roots; gives the one that stays.
    int join(int deep, int shallow, int level) {
        if (basin(shallow).birth < basin(deep).birth) std::swap(deep, shallow);
        if (static_cast<float>(level - basin(shallow).birth) >= config_.prominence_m * levels_per_m)
            report(shallow);
        parent(shallow) = deep;
        basin(deep).pixels += basin(shallow).pixels;
        return deep;
    }

    void report(int root) {
        const bool low = static_cast<float>(basin(root).birth) < config_.highest_m * levels_per_m;
        if (low && basin(root).pixels >= config_.least_pixels) minima_.push_back(basin(root).lowest);
    }

    std::vector<int> parents_;
    std::vector<Basin> basins_;
    std::array<int, 8> neighbours_;
    std::vector<int> minima_;
    HeightMinimaConfig config_;
};

}  // namespace

HeightMinima find_height_minima(std::span<const float> height_m, std::span<const std::uint8_t> member,
                                int width_px, const HeightMinimaConfig& config) {
    const int levels = static_cast<int>((config.highest_m + config.prominence_m) * levels_per_m) + 2;
    const auto level_of = [&](std::size_t i) {
        return static_cast<int>(std::clamp(height_m[i] * levels_per_m, 0.0f, static_cast<float>(levels - 1)));
    };
    std::vector<int> first(static_cast<std::size_t>(levels) + 1, 0);
    for (std::size_t i = 0; i < member.size(); ++i)
        if (member[i] != 0) ++first[static_cast<std::size_t>(level_of(i)) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    struct Level {
        int pixel, level;
    };
    std::vector<Level> order(static_cast<std::size_t>(first.back()));
    const int stride_px = width_px + 2, height_px = static_cast<int>(member.size()) / std::max(width_px, 1);
    std::size_t i = 0;
    for (int y = 1; y <= height_px; ++y) {
        for (int x = 1; x <= width_px; ++x, ++i) {
            if (member[i] == 0) continue;
            const int level = level_of(i);
            order[static_cast<std::size_t>(first[static_cast<std::size_t>(level)]++)] = {y * stride_px + x,
                                                                                         level};
        }
    }
    Flood flood(static_cast<std::size_t>(stride_px * (height_px + 2)), stride_px, config);
    for (const auto& [pixel, level] : order) flood.add(pixel, level);
    HeightMinima found = flood.result();
    for (HeightMinimum& minimum : found.minima)
        minimum.index = (minimum.index / stride_px - 1) * width_px + minimum.index % stride_px - 1;
    return found;
}

}  // namespace touchstone
