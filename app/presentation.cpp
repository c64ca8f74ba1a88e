#include "app/presentation.hpp"

#include <GLES3/gl31.h>
#include <algorithm>
#include <utility>

#include "app/displays.hpp"
#include "app/model_file.hpp"
#include "app/photo_folder.hpp"
#include "platform/system/error.hpp"
#include "platform/system/log.hpp"

namespace touchstone {

namespace {

constexpr std::chrono::seconds between_tries{1};

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
    : Presentation(options, [options] { return open_display(options); }) {}

Presentation::Presentation(const RunOptions& options, DisplayMaker make_display)
    : kind_(choose_display(options.display)),
      make_display_(std::move(make_display)),
      config_(presenter_config(options.config.display)),
      scene_(options.config.display.scene),
      is_projector_(is_projector(options)),
      throws_on_table_(throws_on_table(options)),
      spares_hands_(options.config.projector.spares_hands),
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
    return {presenter_->wish(), presenter_->operator_wish(), {is_projector_, display_->size_px(), shown_}};
}

void Presentation::finish() { glFinish(); }

void Presentation::open() {
    display_ = make_display_();
    if (throws_on_table_)
        projected_ = std::make_unique<ProjectedDisplay>(*display_, ProjectedDisplayConfig{spares_hands_});
    config_.projected = throws_on_table_;
    projector_ = nullptr;
    is_fitted_ = false;
    Display& shown = projected_ ? static_cast<Display&>(*projected_) : *display_;
    presenter_ = std::make_unique<TablePresenter>(shown, scene_, config_);
}

void Presentation::close() {
    presenter_.reset();
    calibration_screen_.reset();
    projected_.reset();
    display_.reset();
    thrown_ = shown_ = nullptr;
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
        close();
    }
}

void Presentation::lose_display() {
    log_warning("the display is lost: trying to get it back");
    scene_ = presenter_->scene_name();
    close();
}

void Presentation::begin_to_throw() {
    const std::vector<std::string> names = scene_names(ScenePlace::surface);
    scene_ = presenter_->scene_name();
    if (std::ranges::find(names, scene_) == names.end()) scene_ = names.front();
    throws_on_table_ = true;
    close();
    open();
}

void Presentation::draw(const TableFrame& frame) {
    if (!presenter_) try_to_open();
    if (!presenter_) return;
    try {
        if (is_projector_ && frame.projector && !throws_on_table_ && !frame.thrown) begin_to_throw();
        if (frame.thrown)
            draw_thrown(frame);
        else
            draw_scene(frame);
    } catch (const Error&) {
        if (display_ && !display_->is_lost()) throw;
        if (display_) lose_display();
    }
    if (frame.view) drawn_index_ = frame.index;
    drawn_arrived_ = frame.arrived;
}

void Presentation::draw_scene(const TableFrame& frame) {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<float> elapsed = now - last_drawn_;
    last_drawn_ = now;
    if (thrown_) show_to_simulated_hands(*display_, std::nullopt);
    thrown_ = shown_ = nullptr;
    presenter_->draw(fit_to_table(frame), elapsed.count());
}

/// In the projector's own pixels, once for each picture; time stands still for the scene.
void Presentation::draw_thrown(const TableFrame& frame) {
    presenter_->pause();
    last_drawn_ = std::chrono::steady_clock::now();
    if (frame.thrown == thrown_) return;
    if (!calibration_screen_) calibration_screen_ = std::make_unique<CalibrationScreen>(*display_);
    calibration_screen_->draw(*frame.thrown);
    show_to_simulated_hands(*display_, frame.thrown->cross_px);
    thrown_ = frame.thrown;
}

const TableFrame& Presentation::fit_to_table(const TableFrame& frame) {
    if (!projected_ || !frame.projector || !frame.has_area) return frame;
    if (is_fitted_ && frame.index == fitted_.index && frame.timestamp_us == fitted_.timestamp_us)
        return fitted_;
    const bool is_new_view = !is_view_of(from_above_, frame);
    if (is_new_view) from_above_ = make_view_from_above(frame.area, frame.T_g_c);
    if (is_new_view || frame.projector != projector_ || frame.surface != surface_)
        projected_->set_mapping(*frame.projector, from_above_, frame.surface.get());
    projector_ = frame.projector;
    surface_ = frame.surface;
    projected_->see_hands(frame);
    fitted_ = seen_from_above(frame, from_above_);
    is_fitted_ = true;
    return fitted_;
}

void Presentation::show() {
    if (!presenter_) return;
    const bool is_thrown = thrown_ != nullptr;
    if (!is_thrown || thrown_ != shown_) (is_thrown || !projected_ ? *display_ : *projected_).present();
    if (display_->is_lost()) {
        lose_display();
        return;
    }
    shown_ = thrown_;
    measure();
    if (!shots_ || drawn_index_ == last_shot_) return;
    last_shot_ = drawn_index_;
    shots_->write_shot(drawn_index_, display_->read_pixels());
}

}  // namespace touchstone
