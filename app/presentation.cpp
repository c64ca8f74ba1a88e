#include "app/presentation.hpp"

#include <GLES3/gl31.h>
#include <cstdlib>
#include <utility>

#include "app/model_file.hpp"
#include "app/photo_folder.hpp"
#include "platform/display/headless_display.hpp"
#include "platform/display/projector_display.hpp"
#include "platform/display/sdl_display.hpp"
#include "platform/system/error.hpp"
#include "platform/system/log.hpp"

namespace touchstone {

namespace {

constexpr std::chrono::seconds between_tries{1};

DisplayKind choose_kind(const RunOptions& options) {
    if (options.display) return *options.display;
    const bool desktop = std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
    return desktop ? DisplayKind::window : DisplayKind::headless;
}

std::unique_ptr<Display> make_display(DisplayKind kind, const DisplayConfig& config, bool is_read) {
    const WindowPixels pixels = is_read ? WindowPixels::readable : WindowPixels::shown_only;
    const PixelSize size{config.width_px, config.height_px};
    switch (kind) {
        case DisplayKind::window:
            return make_sdl_display("Touchstone", size, pixels);
        case DisplayKind::projector:
            return make_projector_display("Touchstone", {config.output, config.mode, pixels});
        case DisplayKind::headless:
            break;
    }
    return make_headless_display(size);
}

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
    : Presentation(options, [kind = choose_kind(options), config = options.config.display,
                             is_read = options.shots_dir.has_value()] {
          return make_display(kind, config, is_read);
      }) {}

Presentation::Presentation(const RunOptions& options, DisplayMaker make_display)
    : kind_(choose_kind(options)),
      make_display_(std::move(make_display)),
      config_(presenter_config(options.config.display)),
      scene_(options.config.display.scene),
      last_drawn_(std::chrono::steady_clock::now()) {
    if (options.shots_dir) shots_.emplace(*options.shots_dir);
    open();
}

Presentation::~Presentation() {
    for (const StageSummary& stage : times_.summary())
        log_debug("{}: median {:.2f} ms, 99 % {:.2f} ms", stage.stage, stage.median_ms, stage.p99_ms);
}

/// A picture of a frame that was shown before has waited for nothing.
void Presentation::measure() {
    if (drawn_arrived_ == last_measured_) return;
    last_measured_ = drawn_arrived_;
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - drawn_arrived_;
    times_.add(to_photon, taken.count());
    times_.end_frame();
}

TableWish Presentation::wish() const {
    if (!presenter_) return {};
    return {presenter_->wish(), presenter_->operator_wish()};
}

void Presentation::finish() { glFinish(); }

void Presentation::open() {
    display_ = make_display_();
    presenter_ = std::make_unique<TablePresenter>(*display_, scene_, config_);
}

void Presentation::try_to_open() {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_try_) return;
    next_try_ = now + between_tries;
    try {
        open();
        log_info("the display is back");
    } catch (const Error& error) {
        log_debug("{}", error.what());
        presenter_.reset();
        display_.reset();
    }
}

void Presentation::lose_display() {
    log_warning("the display is lost: trying to get it back");
    scene_ = presenter_->scene_name();
    presenter_.reset();
    display_.reset();
}

void Presentation::draw(const TableFrame& frame) {
    if (!presenter_) try_to_open();
    if (!presenter_) return;
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<float> elapsed = now - last_drawn_;
    last_drawn_ = now;
    try {
        presenter_->draw(frame, elapsed.count());
    } catch (const Error&) {
        if (!display_->is_lost()) throw;
        lose_display();
    }
    if (frame.view) drawn_index_ = frame.index;
    drawn_arrived_ = frame.arrived;
}

void Presentation::show() {
    if (!presenter_) return;
    display_->present();
    if (display_->is_lost()) {
        lose_display();
        return;
    }
    measure();
    if (!shots_ || drawn_index_ == last_shot_) return;
    last_shot_ = drawn_index_;
    shots_->write_shot(drawn_index_, display_->read_pixels());
}

}  // namespace touchstone
