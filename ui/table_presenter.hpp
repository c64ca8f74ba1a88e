#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "platform/display/display.hpp"
#include "ui/scene_list.hpp"
#include "ui/table_frame.hpp"

namespace touchstone {

struct PresenterConfig {
    bool menu = true;              ///< scenes are changed by touch
    float attract_after_s = 60.f;  ///< without touch or hover; 0: never
    bool projected = false;        ///< the display is the surface itself: see ProjectedDisplay
    SceneSetup scenes;
};

/// Draws the table on a display: the shaded view, a scene, fingers, and the words about it. Where nobody
/// comes it attracts people, over the scene that waits for them. The key o, or a finger that rests in a
/// corner, opens the operator's panel. Lives on the display's thread and dies before the display.
class TablePresenter {
  public:
    /// Throws Error{usage} for an unknown scene, or one for screens only where the display is projected,
    /// Error{unavailable} when fonts or shaders fail.
    TablePresenter(Display& display, const std::string& scene_name, const PresenterConfig& config = {});
    ~TablePresenter();

    /// Takes the frame in, unless it was the last one drawn, and draws. `dt_s` is the time since the last
    /// call.
    void draw(const TableFrame& frame, float dt_s);
    /// Draws, and shows it. Afterwards the display's read_pixels gives the picture.
    void present(const TableFrame& frame, float dt_s);
    /// Something else is shown: nobody touches what is drawn here.
    void pause();
    /// What the scene needs from the perception loop.
    SceneWish wish() const;
    /// What the operator needs from it.
    OperatorWish operator_wish() const;
    const std::string& scene_name() const;

  private:
    struct Parts;

    void take_in(const TableFrame& told);
    void start_scene(const TableFrame& frame);
    void take_keys();
    void deliver(const TouchEvent& event);
    void deliver_to_scene(const TouchEvent& event);
    void take_fingers_from_scene();
    void change_scene(const std::string& name, const TableFrame& frame);
    void lift_all_fingers();
    void update(float dt_s);
    void draw_all(const TableFrame& frame);
    void draw_scene(const TableFrame& frame);
    ScenePlace place() const { return config_.projected ? ScenePlace::surface : ScenePlace::screen; }

    Display& display_;
    PresenterConfig config_;
    std::unique_ptr<Parts> parts_;
    int last_index_ = -1;
    std::uint64_t last_timestamp_us_ = 0;
    float clock_s_ = 0.f;
};

}  // namespace touchstone
