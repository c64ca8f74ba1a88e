#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "ui/gestures.hpp"
#include "ui/surface_room.hpp"

namespace touchstone {

/// A photo that lies on the table. Lengths are pixels of the depth picture.
struct PhotoCard {
    int id = 0;
    Eigen::Vector2f half_px{0.f, 0.f};  ///< from its middle to its edges, border included, at scale 1
    Eigen::Vector2f center_px{0.f, 0.f};
    float rotation_rad = 0.f;  ///< clockwise as seen
    float scale = 1.f;
    Eigen::Vector2f velocity_px_s{0.f, 0.f};
    bool held = false;  ///< by fingers that drag or turn it
    /// Where it glides after a double tap.
    struct Goal {
        Eigen::Vector2f center_px;
        float rotation_rad, scale;
    };
    std::optional<Goal> goal;

    bool contains(const Eigen::Vector2f& place_px) const;
    /// Of the upright box about it, half its size.
    Eigen::Vector2f half_box_px() const;
};

/// Photos that people push around: what gestures do to them, and how they go on when let go.
class PhotoTable {
  public:
    void set_room(const SurfaceRoom& room, float mm_per_px);
    /// Scattered over the room, all of it inside, the last on top. `aspect` is width to height, `of` how many
    /// there will be.
    int add(float aspect, int of);

    /// In the order in which they lie, the topmost last.
    const std::vector<PhotoCard>& cards() const { return cards_; }
    std::optional<int> hit(const Eigen::Vector2f& place_px) const;
    /// A finger came down on it: it comes to the top and stays where it is.
    void grasp(int id);
    void on_gesture(const Gesture& gesture);
    /// Moves time on; true while something moves or has changed.
    bool update(float dt_s);

  private:
    PhotoCard* find(int id);
    void on_drag(PhotoCard& card, const Drag& drag);
    void on_transform(PhotoCard& card, const Transform& transform);
    void on_double_tap(PhotoCard& card);
    void glide(PhotoCard& card, float dt_s) const;
    void slide(PhotoCard& card, float dt_s) const;

    SurfaceRoom room_{{Eigen::Vector2f(0.f, 0.f), Eigen::Vector2f(640.f, 480.f)}};
    float mm_per_px_ = 1.7f;
    std::vector<PhotoCard> cards_;
    int made_ = 0;
    bool changed_ = false;
};

}  // namespace touchstone
