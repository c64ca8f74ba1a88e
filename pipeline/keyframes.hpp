#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/types.hpp"

namespace touchstone {

inline constexpr int small_width_px = 40, small_height_px = 30;

/// A depth picture of 40 x 30 blocks, row-major, millimetres, 0 = unknown.
using SmallPicture = std::array<std::uint16_t, std::size_t{small_width_px} * small_height_px>;

/// Median of the valid depths of each block; unknown where fewer than a quarter of a block's are valid.
SmallPicture make_small_picture(const DepthView& view);

inline constexpr std::size_t fern_count = 500, fern_decisions = 4;

/// What each fern says of a small picture: bit i of a byte is decision i. Unseen where the fern looks at an
/// unknown block.
using FernCode = std::array<std::uint8_t, fern_count>;
inline constexpr std::uint8_t fern_unseen = 0xff;

/// Randomised ferns (Glocker et al., ISMAR 2013): decision i of a fern is whether one block is deeper than
/// one threshold. The ferns are the same in every process: codes can be saved.
FernCode make_fern_code(const SmallPicture& picture);

/// Share of ferns that say different things, of those that see something in both, 0..1. 1 where fewer than a
/// quarter of the ferns do.
float dissimilarity(const FernCode& a, const FernCode& b);

/// A view of the model and from where it was seen.
struct Keyframe {
    RigidTransform T_g_c = RigidTransform::Identity();
    FernCode code{};
};

struct KeyframeConfig {
    /// Of a new keyframe to every other. In a room of furniture keyframes then lie some 50 mm apart, which is
    /// near enough for ICP to do the rest.
    float min_dissimilarity = 0.1f;
    std::size_t max_count = 1000;
};

/// A keyframe that looks like the view asked about.
struct KeyframeMatch {
    RigidTransform T_g_c = RigidTransform::Identity();
    float dissimilarity = 1.0f;
};

/// Where the camera has been, found again by what it sees.
class KeyframeDatabase {
  public:
    explicit KeyframeDatabase(const KeyframeConfig& config = {}) : config_(config) {}
    /// With saved keyframes, all of them kept whatever the limit.
    KeyframeDatabase(const KeyframeConfig& config, std::vector<Keyframe> keyframes)
        : config_(config), keyframes_(std::move(keyframes)) {}

    /// Keeps the view where it differs from all others and the limit allows; true where it does. A view that
    /// shows too little is never kept.
    bool add_if_new(const SmallPicture& picture, const RigidTransform& T_g_c);

    /// Up to `count` keyframes, the most similar first, the older first where equal. None of dissimilarity 1.
    std::vector<KeyframeMatch> most_similar(const SmallPicture& picture, std::size_t count) const;

    std::span<const Keyframe> keyframes() const { return keyframes_; }
    /// New views are not kept any more.
    bool is_full() const { return keyframes_.size() >= config_.max_count; }

  private:
    KeyframeConfig config_;
    std::vector<Keyframe> keyframes_;
};

}  // namespace touchstone
