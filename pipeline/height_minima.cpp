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

    /// The pixels of one row from `first` to before `end` at once, which all have the highest level.
    void add_run(int first, int end, int level) {
        for (int pixel = first; pixel < end; ++pixel) parent(pixel) = first;
        basin(first) = {end - first, level, first};
        int mine = first, last = dry;
        const auto meet = [&](int pixel) {
            const int next = parent(pixel);
            if (next == dry || next == last) return;
            last = next;
            const int other = root(next);
            if (other != mine) mine = join(mine, other, level);
        };
        const int stride_px = neighbours_[6];
        for (const int row : {-stride_px, stride_px})
            for (int pixel = first - 1; pixel <= end; ++pixel) meet(pixel + row);
        meet(first - 1);
        meet(end);
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

/// Pixels with their levels, lowest first: of those below the level `top`, in the numbers of the Flood.
std::vector<std::pair<int, int>> in_order(std::span<const int> level, int width_px, int top) {
    std::vector<int> next(static_cast<std::size_t>(top) + 1, 0);
    for (const int l : level)
        if (l >= 0 && l < top) ++next[static_cast<std::size_t>(l) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<std::pair<int, int>> order(static_cast<std::size_t>(next.back()));
    int pixel = width_px + 3, x = 0;
    for (const int l : level) {
        if (l >= 0 && l < top)
            order[static_cast<std::size_t>(next[static_cast<std::size_t>(l)]++)] = {pixel, l};
        const bool row_ends = ++x == width_px;
        pixel += row_ends ? 3 : 1;
        if (row_ends) x = 0;
    }
    return order;
}

/// Half of an arm is so high that the order does not matter any more.
void flood_highest(std::span<const int> level, int width_px, int top, Flood& flood) {
    int before_row = width_px + 3;
    for (; !level.empty();
         level = level.subspan(static_cast<std::size_t>(width_px)), before_row += width_px + 2) {
        const auto row = level.first(static_cast<std::size_t>(width_px));
        for (auto from = std::ranges::find(row, top); from != row.end();) {
            const auto end = std::find_if(from, row.end(), [&](int l) { return l != top; });
            flood.add_run(before_row + static_cast<int>(from - row.begin()),
                          before_row + static_cast<int>(end - row.begin()), top);
            from = std::find(end, row.end(), top);
        }
    }
}

}  // namespace

HeightMinima find_height_minima(std::span<const float> height_m, std::span<const std::uint8_t> member,
                                int width_px, const HeightMinimaConfig& config) {
    const int top = static_cast<int>((config.highest_m + config.prominence_m) * levels_per_m) + 1;
    std::vector<int> level(member.size(), -1);
    for (std::size_t i = 0; i < member.size(); ++i) {
        if (member[i] != 0)
            level[i] =
                static_cast<int>(std::clamp(height_m[i] * levels_per_m, 0.0f, static_cast<float>(top)));
    }
    const int stride_px = width_px + 2, height_px = static_cast<int>(member.size()) / std::max(width_px, 1);
    Flood flood(static_cast<std::size_t>(stride_px * (height_px + 2)), stride_px, config);
    for (const auto& [pixel, its_level] : in_order(level, width_px, top)) flood.add(pixel, its_level);
    flood_highest(level, width_px, top, flood);
    HeightMinima found = flood.result();
    for (HeightMinimum& minimum : found.minima)
        minimum.index = (minimum.index / stride_px - 1) * width_px + minimum.index % stride_px - 1;
    return found;
}

}  // namespace touchstone
