#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "app/command_line.hpp"
#include "app/frame_outputs.hpp"
#include "platform/display/display.hpp"
#include "ui/table_presenter.hpp"

namespace touchstone {

/// The presentation loop's side: the latest result -> scene -> display. Lives on one thread.
class Presentation {
  public:
    /// Throws Error{unavailable} where there is no display of the kind, {usage} for an unknown scene.
    explicit Presentation(const RunOptions& options);

    void show(const TableFrame& frame);
    SceneWish wish() const { return presenter_.wish(); }
    /// The user closed the window.
    bool should_close() { return display_->should_close(); }
    /// A window goes on drawing between frames, so that it animates and takes events.
    bool animates() const { return kind_ == DisplayKind::window; }

  private:
    DisplayKind kind_;
    std::unique_ptr<Display> display_;
    TablePresenter presenter_;
    std::optional<PictureFolder> shots_;
    std::chrono::steady_clock::time_point last_shown_;
    int last_shot_ = -1;
};

}  // namespace touchstone
