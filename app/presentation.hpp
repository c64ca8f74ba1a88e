#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>

#include "app/command_line.hpp"
#include "app/frame_outputs.hpp"
#include "app/perception.hpp"
#include "platform/display/display.hpp"
#include "platform/system/stage_timer.hpp"
#include "ui/calibration_screen.hpp"
#include "ui/projected_display.hpp"
#include "ui/table_presenter.hpp"

namespace touchstone {

/// Called again when a display is lost.
using DisplayMaker = std::function<std::unique_ptr<Display>()>;

/// The presentation loop's side: the latest result -> scene -> display. Lives on one thread. A display that
/// is lost is made anew, and the scene on it begins anew; until that succeeds nothing is seen.
class Presentation {
  public:
    /// Throws Error{unavailable} where there is no display of the kind, {usage} for an unknown scene.
    explicit Presentation(const RunOptions& options);
    /// On a display that somebody else makes.
    Presentation(const RunOptions& options, DisplayMaker make_display);
    /// Says how long touches took to the screen, at log level debug.
    ~Presentation();

    void draw(const TableFrame& frame);
    /// Shows what was drawn; may wait for the screen.
    void show();
    TableWish wish() const;
    /// The user closed the window.
    bool should_close() { return display_ && display_->should_close(); }
    /// Waits until what was shown is drawn, for those who measure.
    void finish();
    /// A window goes on drawing between frames, so that it animates and takes events.
    bool animates() const { return kind_ != DisplayKind::headless; }

  private:
    void open();
    /// At most every second.
    void try_to_open();
    void lose_display();
    /// On the table itself: the frame as its display shows it, thrown as the frame says.
    const TableFrame& fit_to_table(const TableFrame& frame);
    void measure();
    void draw_scene(const TableFrame& frame);
    void draw_thrown(const TableFrame& frame);
    /// The first calibration of a projector: from now on its picture is fitted to the table.
    void begin_to_throw();
    void close();

    static constexpr std::string_view to_photon = "touch to photon";

    DisplayKind kind_;
    DisplayMaker make_display_;
    PresenterConfig config_;
    std::string scene_;
    bool is_projector_, throws_on_table_, spares_hands_;
    std::unique_ptr<Display> display_;
    std::unique_ptr<ProjectedDisplay> projected_;  ///< over display_, where it throws on the table
    ViewFromAbove from_above_;
    TableFrame fitted_;  ///< the last frame, seen from above
    bool is_fitted_ = false;
    std::shared_ptr<const ProjectorModel> projector_;  ///< of the last frame, with its surface
    std::shared_ptr<const SurfaceGrid> surface_;
    std::unique_ptr<TablePresenter> presenter_;
    std::unique_ptr<CalibrationScreen> calibration_screen_;  ///< since it was first wanted
    std::shared_ptr<const ThrownPicture> thrown_, shown_;    ///< drawn, and shown, instead of the scene
    std::optional<PictureFolder> shots_;
    std::chrono::steady_clock::time_point last_drawn_, next_try_{};
    int drawn_index_ = -1, last_shot_ = -1;  ///< drawn_index_ only of frames with a view
    StageTimes times_;
    std::chrono::steady_clock::time_point drawn_arrived_{}, last_measured_{};
};

}  // namespace touchstone
