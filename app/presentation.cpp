#include "app/presentation.hpp"

#include "app/displays.hpp"
#include "app/model_file.hpp"
#include "app/photo_folder.hpp"

namespace touchstone {

namespace {

PresenterConfig presenter_config(const DisplayConfig& config) {
    PresenterConfig presenter;
    presenter.menu = config.menu;
    presenter.attract_after_s = config.attract_after_s;
    presenter.scenes.painting_file = config.painting_file;
    if (!config.model.empty()) presenter.scenes.model = load_model(config.model);
    presenter.scenes.photo_folder = config.photos;
    if (!config.photos.empty())
        presenter.scenes.open_photos = [folder = config.photos] { return open_photo_folder(folder); };
    return presenter;
}

}  // namespace

Presentation::Presentation(const RunOptions& options)
    : kind_(choose_display(options.display)),
      display_(open_display(kind_, options.config.display)),
      presenter_(*display_, options.config.display.scene, presenter_config(options.config.display)),
      last_shown_(std::chrono::steady_clock::now()) {
    if (options.shots_dir) shots_.emplace(*options.shots_dir);
}

void Presentation::show(const TableFrame& frame) {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<float> elapsed = now - last_shown_;
    last_shown_ = now;
    presenter_.present(frame, elapsed.count());
    if (!shots_ || !frame.view || frame.index == last_shot_) return;
    last_shot_ = frame.index;
    shots_->write_shot(frame.index, display_->read_pixels());
}

}  // namespace touchstone
