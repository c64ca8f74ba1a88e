#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/types.hpp"
#include "ui/style.hpp"

namespace touchstone {

/// Paint on the surface, where a finger went; its ends are round.
struct Stroke {
    style::Color color;
    float width_mm = 0.f;
    bool erases = false;                      ///< takes away what lies under it, instead of painting
    std::vector<Eigen::Vector3f> points_g_m;  ///< on the surface
};

/// A painting that fills the table; all of it is drawn anew after an undo.
struct PaintingLimits {
    std::size_t points = 12'000, deeds = 2'000;
};

/// All that was painted, in order, in the frame of the scan. What is undone is forgotten; beyond the limits
/// the oldest goes.
class Painting {
  public:
    /// Nearer places of a finger are the same.
    static constexpr float least_step_m = 0.001f;

    explicit Painting(PaintingLimits limits = {}) : limits_(limits) {}

    /// A stroke with one point; the number by which it goes on.
    int begin(style::Color color, float width_mm, bool erases, const Eigen::Vector3f& point_g_m);
    /// False when the point is not taken: too near the last one, or the stroke is gone.
    bool extend(int number, const Eigen::Vector3f& point_g_m);
    void finish(int number);
    /// Takes back the last finished stroke or the last clear(). False when there is none.
    bool undo();
    /// Takes all away, which undo() brings back. Unfinished strokes are finished.
    void clear();
    bool can_undo() const;
    bool is_empty() const { return visible().empty(); }

    /// What is to be seen, in order.
    std::vector<const Stroke*> visible() const;
    const Stroke* stroke(int number) const;
    std::size_t points() const { return points_; }
    /// Grows with every change that takes away or brings back.
    int redraws() const { return redraws_; }
    /// To another frame of reference.
    void move(const RigidTransform& T_new_old);

    /// Everything that is finished, undo included.
    std::string bytes() const;
    /// Throws Error{bad_data} when it is not what bytes() gave.
    static Painting from_bytes(std::string_view bytes, PaintingLimits limits = {});

  private:
    struct Deed {
        int number = 0;
        bool is_clear = false;
        bool finished = true;
        Stroke stroke;
    };
    Deed* find(int number);
    void keep_to_limits();

    PaintingLimits limits_;
    std::deque<Deed> deeds_;
    int numbers_given_ = 0;
    std::size_t points_ = 0;
    int redraws_ = 0;
};

}  // namespace touchstone
