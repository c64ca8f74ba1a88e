#include "pipeline/keyframes.hpp"

#include <algorithm>
#include <random>

namespace touchstone {

namespace {

constexpr int samples_per_side = 8;  // at most, of a block
constexpr float min_threshold_m = 0.5f, max_threshold_m = 4.5f;

struct Decision {
    std::size_t block;
    std::uint16_t threshold_mm;
};
using Ferns = std::array<std::array<Decision, fern_decisions>, fern_count>;

/// 0..1 of 32 random bits: the same with every standard library, unlike std::uniform_real_distribution.
double fraction(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

Ferns make_ferns() {
    std::mt19937 random(2013);
    Ferns ferns{};
    for (auto& fern : ferns) {
        for (Decision& decision : fern) {
            decision.block = static_cast<std::size_t>(fraction(random) * small_width_px * small_height_px);
            const double inverse =
                1.0 / max_threshold_m + fraction(random) * (1.0 / min_threshold_m - 1.0 / max_threshold_m);
            decision.threshold_mm = static_cast<std::uint16_t>(1000.0 / inverse);
        }
    }
    return ferns;
}

/// Median of the block's valid depths, every n-th row and column of it.
std::uint16_t block_depth_mm(const DepthView& view, int block_x, int block_y,
                             std::vector<std::uint16_t>& valid) {
    const int width = view.intrinsics.width_px, height = view.intrinsics.height_px;
    const int x0 = block_x * width / small_width_px, x1 = (block_x + 1) * width / small_width_px;
    const int y0 = block_y * height / small_height_px, y1 = (block_y + 1) * height / small_height_px;
    const int step_x = std::max(1, (x1 - x0) / samples_per_side);
    const int step_y = std::max(1, (y1 - y0) / samples_per_side);
    valid.clear();
    std::size_t all = 0;
    for (int y = y0; y < y1; y += step_y) {
        for (int x = x0; x < x1; x += step_x, ++all) {
            const std::uint16_t depth_mm = view.depth_mm[static_cast<std::size_t>(y * width + x)];
            if (depth_mm > 0) valid.push_back(depth_mm);
        }
    }
    if (valid.empty() || 4 * valid.size() < all) return 0;
    const auto middle = valid.begin() + static_cast<std::ptrdiff_t>(valid.size() / 2);
    std::ranges::nth_element(valid, middle);
    return *middle;
}

bool sees_enough(const FernCode& code) { return dissimilarity(code, code) == 0.0f; }

}  // namespace

SmallPicture make_small_picture(const DepthView& view) {
    SmallPicture picture{};
    std::vector<std::uint16_t> valid;
    std::size_t block = 0;
    for (int y = 0; y < small_height_px; ++y) {
        for (int x = 0; x < small_width_px; ++x) picture[block++] = block_depth_mm(view, x, y, valid);
    }
    return picture;
}

FernCode make_fern_code(const SmallPicture& picture) {
    static const Ferns ferns = make_ferns();
    FernCode code{};
    for (std::size_t i = 0; i < fern_count; ++i) {
        unsigned bits = 0;
        bool seen = true;
        for (std::size_t j = 0; j < fern_decisions; ++j) {
            const std::uint16_t depth_mm = picture[ferns[i][j].block];
            seen = seen && depth_mm > 0;
            bits |= static_cast<unsigned>(depth_mm > ferns[i][j].threshold_mm) << j;
        }
        code[i] = seen ? static_cast<std::uint8_t>(bits) : fern_unseen;
    }
    return code;
}

float dissimilarity(const FernCode& a, const FernCode& b) {
    int compared = 0, different = 0;
    for (std::size_t i = 0; i < fern_count; ++i) {
        const bool both = (a[i] != fern_unseen) & (b[i] != fern_unseen);
        compared += both;
        different += both & (a[i] != b[i]);
    }
    if (4 * compared < static_cast<int>(fern_count)) return 1.0f;
    return static_cast<float>(different) / static_cast<float>(compared);
}

bool KeyframeDatabase::add_if_new(const SmallPicture& picture, const RigidTransform& T_g_c) {
    if (is_full()) return false;
    const FernCode code = make_fern_code(picture);
    if (!sees_enough(code)) return false;
    const bool is_new = std::ranges::all_of(keyframes_, [&](const Keyframe& keyframe) {
        return dissimilarity(code, keyframe.code) > config_.min_dissimilarity;
    });
    if (is_new) keyframes_.push_back({T_g_c, code});
    return is_new;
}

std::vector<KeyframeMatch> KeyframeDatabase::most_similar(const SmallPicture& picture,
                                                          std::size_t count) const {
    const FernCode code = make_fern_code(picture);
    std::vector<KeyframeMatch> matches;
    for (const Keyframe& keyframe : keyframes_) {
        const float difference = dissimilarity(code, keyframe.code);
        if (difference < 1.0f) matches.push_back({keyframe.T_g_c, difference});
    }
    std::ranges::stable_sort(matches, {}, &KeyframeMatch::dissimilarity);
    if (matches.size() > count)
        matches.erase(matches.begin() + static_cast<std::ptrdiff_t>(count), matches.end());
    return matches;
}

}  // namespace touchstone
