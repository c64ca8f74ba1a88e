#include "pipeline/height_minima.hpp"

#include <algorithm>
#include <numeric>

namespace touchstone {

namespace {

constexpr float levels_per_m = 1000.0f;

struct Basin {
    int parent = -1;  ///< -1: the pixel is not flooded yet
    int pixels = 0;
    int birth = 0;   ///< level of its lowest pixel
    int lowest = 0;  ///< that pixel
};

/// Union-find over pixels flooded in order of height.
class Flood {
  public:
    Flood(int pixels, int width_px, const HeightMinimaConfig& config)
        : basins_(static_cast<std::size_t>(pixels)), width_px_(width_px), config_(config) {}

    void add(int pixel, int level) {
        at(pixel) = {pixel, 1, level, pixel};
        const int x = pixel % width_px_;
        const int left = x > 0 ? -1 : 0, right = x + 1 < width_px_ ? 1 : 0;
        for (const int row : {-width_px_, 0, width_px_}) {
            if (pixel + row < 0 || pixel + row >= static_cast<int>(basins_.size())) continue;
            for (int step = left; step <= right; ++step) {
                const int neighbour = pixel + row + step;
                if (neighbour != pixel && at(neighbour).parent >= 0) join(pixel, neighbour, level);
            }
        }
    }

    HeightMinima result() {
        HeightMinima found;
        std::vector<int> object(basins_.size(), -1);
        for (int pixel = 0; pixel < static_cast<int>(basins_.size()); ++pixel) {
            if (at(pixel).parent != pixel) continue;
            object[static_cast<std::size_t>(pixel)] = static_cast<int>(found.object_pixels.size());
            found.object_pixels.push_back(at(pixel).pixels);
            report(pixel);
        }
        for (const int minimum : minima_)
            found.minima.push_back({minimum, object[static_cast<std::size_t>(root(minimum))]});
        return found;
    }

  private:
    Basin& at(int pixel) { return basins_[static_cast<std::size_t>(pixel)]; }

    int root(int pixel) {
        while (at(pixel).parent != pixel) pixel = at(pixel).parent = at(at(pixel).parent).parent;
        return pixel;
    }

    void join(int a, int b, int level) {
        int deep = root(a), shallow = root(b);
        if (deep == shallow) return;
        if (at(shallow).birth < at(deep).birth) std::swap(deep, shallow);
        if (static_cast<float>(level - at(shallow).birth) >= config_.prominence_m * levels_per_m)
            report(shallow);
        at(shallow).parent = deep;
        at(deep).pixels += at(shallow).pixels;
    }

    void report(int basin) {
        const bool low = static_cast<float>(at(basin).birth) < config_.highest_m * levels_per_m;
        if (low && at(basin).pixels >= config_.least_pixels) minima_.push_back(at(basin).lowest);
    }

    std::vector<Basin> basins_;
    std::vector<int> minima_;
    int width_px_;
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
    std::vector<int> order(static_cast<std::size_t>(first.back()));
    for (std::size_t i = 0; i < member.size(); ++i)
        if (member[i] != 0)
            order[static_cast<std::size_t>(first[static_cast<std::size_t>(level_of(i))]++)] =
                static_cast<int>(i);
    Flood flood(static_cast<int>(member.size()), width_px, config);
    for (const int pixel : order) flood.add(pixel, level_of(static_cast<std::size_t>(pixel)));
    return flood.result();
}

}  // namespace touchstone
