#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pipeline/connected_components.hpp"
#include "pipeline/data_association.hpp"
#include "pipeline/maps.hpp"
#include "pipeline/types.hpp"
#include "platform/opencl/program.hpp"

namespace touchstone {

struct MovingPartsConfig {
    DataAssociationConfig association;
    ConnectedComponentsConfig components;
    int cells_per_side = 64;      ///< of the grid that remembers free space, a multiple of 8
    int enough_frames = 4;        ///< in which a cell was seen free before it is believed, 1..255
    int most_frames = 30;         ///< that are counted, 1..255
    int min_seeds = 40;           ///< pixels of a component that came, or lie in free space
    float min_seed_share = 0.1f;  ///< of a component's pixels
    /// Where nothing is known and something comes, all that is connected to it comes: a hand at an object.
    /// Else only what is before the model or in free space: a room shows new walls all the time.
    bool into_unknown = false;
    /// Of a camera since the picture three frames ago: one that turns faster shears what it reads row by row,
    /// and edges of still things then look as if they had moved. Not for objects, which are turned.
    float max_turn_deg = 3.0f;
    /// While something large moves, a surface must have been there in so many frames before the camera is
    /// tracked by it, at most 255: somebody who comes in from the side is at first a new surface like any
    /// other. Less than so many, the model's surface can be grown into, too. 0: at once.
    int young_frames = 30;
    /// Something large: of the picture, in so many more frames than not, of which at most so many are
    /// counted. What is found by mistake in a real room (up to 5 % of a frame) is gone in the next.
    float min_watched_share = 0.02f;
    int min_watched_frames = 4, most_watched_frames = 20;
    /// Of the picture, that moves: less of it cannot take the camera along, and what is new helps to track.
    float untracked_young_share = 0.25f;
    float min_old_share = 0.2f;  ///< of the live pixels; where less is old, the young are tracked by
    int hold_frames = 150;       ///< that something which came is left out when it rests, at most 255
    int widen_px = 8;            ///< of the mask, at most 8
};

/// What moves apart from the model before a camera that moves, too: people in a room, hands at an object. A
/// still scene shows new surfaces only where nobody has looked before; what shows up in space that was seen
/// free came there by itself.
class MovingParts {
  public:
    /// `side_m`: of the volume's cube.
    MovingParts(const Device& device, const MovingPartsConfig& config, const Intrinsics& intrinsics,
                float side_m);

    /// Finds them in a live picture of the camera at T_g_c, which is T_p_c before the prediction. Waits for
    /// the device. Gives their share of the picture.
    float find(const LiveMaps& live, const SurfacePrediction& model, const RigidTransform& T_p_c,
               const RigidTransform& T_g_c);
    /// Map of what was found last, widened: 255 on moving parts, else 0.
    const Buffer<std::uint8_t>& mask() const { return mask_; }
    /// The same with what may turn out to move: the camera is better tracked by the rest.
    const Buffer<std::uint8_t>& untracked() const { return untracked_; }
    /// Remembers a picture of the camera at T_g_c, of which find() has found what moves; `fused`: also as
    /// free space for long.
    void remember(const LiveMaps& live, const RigidTransform& T_g_c, bool fused);
    /// The camera is lost: nothing that was found holds.
    void forget();
    /// Frames in which each cell of the grid was free, x fastest.
    const Buffer<std::uint8_t>& seen_free() const { return seen_free_; }

  private:
    /// The picture of some frames ago.
    struct Before {
        Buffer<float> nearest_m;  // in windows of 8 pixels
        RigidTransform T_g_b = RigidTransform::Identity();
    };

    bool turns_fast(const RigidTransform& T_b_c) const;
    /// Fewer than a component needs: then there is none, and no need to look for it.
    bool has_enough_seeds() const;
    int young_frames() const;
    void mark_untracked(const LiveMaps& live, float moving_share);
    bool enough_is_old(const LiveMaps& live) const;
    float select_components(const std::vector<Component>& found);
    void remember_free_space(const LiveMaps& live, const RigidTransform& T_g_c);

    MovingPartsConfig config_;
    Intrinsics intrinsics_;
    MapShape shape_;
    float cell_m_;
    DataAssociation association_;
    ConnectedComponents components_;
    Program program_, segmentation_;
    Kernel copy_windows_, double_windows_, mark_taken_, remember_free_space_, mark_moving_, join_masks_,
        hold_moving_;
    Kernel widen_columns_, keep_supported_seeds_, widen_rows_;
    Buffer<std::uint8_t> codes_, candidates_, members_, none_expected_, parts_, wide_, mask_, young_,
        untracked_, seen_free_, seen_taken_, taken_now_, held_, last_held_;
    int watched_frames_ = 0;  // with something large that moves, less those without
    int remembered_frames_ = 0;
    bool holds_ = false;  // a pixel of the last frame is held to move
    Buffer<int> labels_;
    Buffer<float> no_fallback_m_, last_m_, windows_m_;  // windows_m_: nearest depths, see moving_parts.cl
    std::array<Before, 3> before_;                      // the oldest is next_before_
    std::size_t next_before_ = 0;
    std::vector<int> numbers_;
};

}  // namespace touchstone
