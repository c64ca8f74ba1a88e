#include "pipeline/foreground_view.hpp"

#include <algorithm>

#include "pipeline/bulkiest_place.hpp"

namespace touchstone {

namespace {

constexpr int block_px = 8;
constexpr int fewest_pixels = 3;  // of a cell

std::size_t index(const MaskedDepth& picture, int x, int y) {
    return static_cast<std::size_t>(y * picture.pitch_px + x);
}

/// Blocks of pixels, 255 where at least half of one is foreground.
std::vector<std::uint8_t> blocks_of(const MaskedDepth& picture, int width, int height) {
    std::vector<int> counts(static_cast<std::size_t>(width * height), 0);
    for (int y = 0; y < height * block_px; ++y) {
        for (int x = 0; x < width * block_px; ++x)
            counts[static_cast<std::size_t>(y / block_px * width + x / block_px)] +=
                picture.mask[index(picture, x, y)] != 0;
    }
    std::vector<std::uint8_t> blocks;
    for (const int count : counts) blocks.push_back(2 * count >= block_px * block_px ? 255 : 0);
    return blocks;
}

/// Median depth of the foreground in a block; 0 where there is none.
float depth_of_block_m(const MaskedDepth& picture, const GridPlace& block) {
    std::vector<float> depths_m;
    for (int y = block.y * block_px; y < (block.y + 1) * block_px; ++y) {
        for (int x = block.x * block_px; x < (block.x + 1) * block_px; ++x) {
            const std::size_t at = index(picture, x, y);
            if (picture.mask[at] != 0 && picture.depth_m[at] > 0.0f) depths_m.push_back(picture.depth_m[at]);
        }
    }
    if (depths_m.empty()) return 0.0f;
    const auto middle = depths_m.begin() + static_cast<std::ptrdiff_t>(depths_m.size() / 2);
    std::ranges::nth_element(depths_m, middle);
    return *middle;
}

/// Books the picture's pixels in cells.
class Cells {
  public:
    Cells(const RigidTransform& T_c_v, float cell_m)
        : T_c_v_(T_c_v), T_v_c_(T_c_v.inverse()), cell_m_(cell_m) {}

    /// A foreground pixel lies where it is; a background pixel empties the cell that its ray passes at the
    /// depth of the origin.
    void add(const Eigen::Vector3f& p_c_m, bool is_foreground) {
        const float origin_m = T_c_v_.translation().z();
        const Eigen::Vector3f p_v_m =
            T_v_c_ * (is_foreground ? p_c_m : Eigen::Vector3f(p_c_m * (origin_m / p_c_m.z())));
        constexpr int side = ForegroundView::side;
        const int x = static_cast<int>(std::floor(p_v_m.x() / cell_m_ + 0.5f)) + side / 2;
        const int y = static_cast<int>(std::floor(p_v_m.y() / cell_m_ + 0.5f)) + side / 2;
        if (x < 0 || y < 0 || x >= side || y >= side) return;
        const auto at = static_cast<std::size_t>(y * side + x);
        if (!is_foreground) {
            ++empty_[at];
            return;
        }
        ++seen_[at];
        sum_m_[at] += p_v_m.z();
    }
    ForegroundView view() const {
        ForegroundView view{T_c_v_, {}, {}};
        for (std::size_t i = 0; i < seen_.size(); ++i) {
            const bool is_seen = seen_[i] >= fewest_pixels, is_empty = empty_[i] >= fewest_pixels;
            view.cells.push_back(is_seen    ? ForegroundView::Cell::seen
                                 : is_empty ? ForegroundView::Cell::empty
                                            : ForegroundView::Cell::unknown);
            view.depth_m.push_back(is_seen ? sum_m_[i] / static_cast<float>(seen_[i]) : 0.0f);
        }
        return view;
    }

  private:
    static constexpr auto count = static_cast<std::size_t>(ForegroundView::side * ForegroundView::side);
    RigidTransform T_c_v_, T_v_c_;
    float cell_m_;
    std::vector<int> seen_ = std::vector<int>(count), empty_ = std::vector<int>(count);
    std::vector<float> sum_m_ = std::vector<float>(count);
};

}  // namespace

std::optional<ForegroundView> view_foreground(const MaskedDepth& picture, float cell_m) {
    const Intrinsics& k = picture.intrinsics;
    const int width = k.width_px / block_px, height = k.height_px / block_px;
    const GridPlace block = bulkiest_place(blocks_of(picture, width, height), width, height);
    if (block.radius_cells <= 0.0f) return std::nullopt;
    const float z_m = depth_of_block_m(picture, block);
    if (z_m <= 0.0f) return std::nullopt;
    const auto middle_px = [](int b) { return (static_cast<float>(b) + 0.5f) * block_px; };
    RigidTransform T_c_v = RigidTransform::Identity();
    T_c_v.translation() = back_project(k, middle_px(block.x), middle_px(block.y), z_m);
    T_c_v.linear() =
        Eigen::Quaternionf::FromTwoVectors(Eigen::Vector3f::UnitZ(), T_c_v.translation()).toRotationMatrix();
    Cells cells(T_c_v, cell_m);
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const std::size_t at = index(picture, x, y);
            const float z = picture.depth_m[at];
            if (z > 0.0f) cells.add(back_project(k, x, y, z), picture.mask[at] != 0);
        }
    }
    return cells.view();
}

}  // namespace touchstone
