#include "app/projector_desk.hpp"

#include <cctype>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>

#include "platform/system/error.hpp"
#include "platform/system/log.hpp"

namespace touchstone {
namespace {

constexpr ProjectorCalibrationConfig on_wish{.patience_frames = 1800};  // a minute
constexpr int quiet_frames = 45, quiet_frames_after_somebody = 150;
constexpr int most_put_off = 8;
constexpr int most_unshown_frames = 150;

std::int64_t seconds_now() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::seconds>(now).count();
}

std::string sentence(std::string words) {
    words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
    return words + ".";
}

}  // namespace

ProjectorDesk::ProjectorDesk(const ProjectorMappingConfig& config) : config_(config) {
    if (!config_.file.empty()) load();
}

void ProjectorDesk::load() {
    try {
        const SavedProjector saved = load_projector(config_.file);
        mapping_.emplace(saved, config_.moves_with_camera);
        calibrated_ = saved.model;
        written_on_ = day_of(saved);
        words_ = fmt::format("The projector was calibrated on {} to {:.1f} mm by {}.", written_on_,
                             saved.rms_mm, saved.method);
        log_info("{} {}", words_, config_.file);
    } catch (const Error& error) {
        words_ = "The projector is not calibrated.";
        log_warning(
            "{}; the picture is not fitted to the surface: run touchstone calibrate, or calibrate from "
            "the operator's panel",
            error.what());
    }
}

/// A file of another resolution is stretched to this one, which need not be right.
void ProjectorDesk::see(const ProjectorScreen& screen) {
    const bool is_new_size = screen.is_projector && screen.size_px != screen_.size_px;
    screen_ = screen;
    if (!is_new_size || !mapping_) return;
    size_note_.clear();
    const PixelSize calibrated{calibrated_.width_px, calibrated_.height_px};
    if (calibrated == screen.size_px) return;
    size_note_ = fmt::format(
        "The projector was calibrated at {}x{}, and shows {}x{} now: calibrate it again.",
        calibrated.width_px, calibrated.height_px, screen.size_px.width_px, screen.size_px.height_px);
    log_warning("{} {}", size_note_, config_.file);
}

void ProjectorDesk::say(const std::string& words, bool is_good) {
    words_ = words;
    if (is_good)
        log_info("{}", words);
    else
        log_warning("{}", words);
}

void ProjectorDesk::calibrate(bool can_see_color) {
    if (!can_calibrate() || calibrates()) return;
    const bool by_light = can_see_color && !light_failed_;
    log_info("the operator asks for the calibration of the projector, by {}", by_light ? "light" : "touch");
    watch_.reset();
    unshown_ = 0;
    calibration_.emplace(by_light ? CalibrationMethod::graycode : CalibrationMethod::touch, screen_.size_px,
                         on_wish);
}

void ProjectorDesk::give_up(const std::string& why) {
    put_off_watch();
    if (!calibration_) return;
    calibration_.reset();
    say("The projector is not calibrated anew: " + why + ".", false);
}

bool ProjectorDesk::wants_held_exposure() const {
    return (watch_ && watch_->wants_held_exposure()) || (calibration_ && calibration_->wants_held_exposure());
}

std::shared_ptr<const ThrownPicture> ProjectorDesk::thrown() const {
    if (calibration_) return calibration_->picture();
    return watch_ ? watch_->picture() : nullptr;
}

std::string ProjectorDesk::note() const {
    const std::string note = mapping_ ? mapping_->note() : std::string();
    return note.empty() ? size_note_ : note;
}

/// The screen is another loop's: frames that it has not drawn yet do not count.
bool ProjectorDesk::is_shown(const std::shared_ptr<const ThrownPicture>& picture) {
    if (screen_.is_projector && screen_.shown == picture) {
        unshown_ = 0;
        return true;
    }
    if (++unshown_ > most_unshown_frames) give_up("the display does not show its pictures");
    return false;
}

void ProjectorDesk::follow(const TableLook& look, bool can_see_color) {
    if (mapping_) mapping_->follow(look.seen.state, look.pipeline.background(), look.frame.intrinsics);
    if (calibration_)
        follow_calibration(look);
    else if (mapping_)
        follow_watch(look, can_see_color);
}

void ProjectorDesk::follow_calibration(const TableLook& look) {
    if (!is_shown(calibration_->picture())) return;
    try {
        calibration_->take(look);
        if (!calibration_->result()) return;
        const CalibrationResult result = *calibration_->result();
        calibration_.reset();
        take_over(result, look);
    } catch (const Error& error) {
        give_up(error.what());
    }
}

void ProjectorDesk::take_over(const CalibrationResult& result, const TableLook& look) {
    if (result.fit.verdict != ProjectorVerdict::good) {
        light_failed_ = result.method == "graycode" && !light_failed_;
        say(fmt::format("The projector is not calibrated anew: {}.{}", result.verdict,
                        light_failed_ ? " The next calibration asks for touches instead." : ""),
            false);
        return;
    }
    light_failed_ = false;
    const RigidTransform T_c_g = look.pipeline.background()->T_g_c().inverse(Eigen::Isometry);
    const SavedProjector saved{in_other_frame(result.fit.model, T_c_g),
                               result.method,
                               result.fit.rms_px,
                               result.fit.rms_mm,
                               result.fit.used,
                               seconds_now()};
    mapping_.emplace(saved, config_.moves_with_camera);
    mapping_->follow(look.seen.state, look.pipeline.background(), look.frame.intrinsics);
    calibrated_ = saved.model;
    written_on_ = day_of(saved);
    size_note_.clear();
    answered_ = 0;
    quiet_ = put_off_ = 0;
    say("The projector is calibrated: " + result.verdict + ".", true);
    try {
        save_projector(config_.file, saved);
        unsaved_.clear();
        log_info("kept in {}", config_.file);
    } catch (const Error& error) {
        unsaved_ = error.what();
        say(fmt::format("{} It is not kept: {}.", words_, unsaved_), false);
    }
}

void ProjectorDesk::follow_watch(const TableLook& look, bool can_see_color) {
    const bool is_due = mapping_->doubts() != answered_ && config_.check_mm > 0.0f && screen_.is_projector;
    if (!is_due || !mapping_->model()) return;
    if (!can_see_color) {
        say(fmt::format("The camera has no colours: where the projector's light falls cannot be checked. "
                        "It was calibrated on {}.",
                        written_on_),
            true);
        answered_ = mapping_->doubts();
        return;
    }
    if (look.is_disturbed()) {
        put_off_watch();
        return;
    }
    ++quiet_;
    const int wanted = put_off_ > 0 ? quiet_frames_after_somebody : quiet_frames;
    try {
        if (!watch_ && quiet_ >= wanted) begin_watch(look);
        if (!watch_ || !is_shown(watch_->picture())) return;
        watch_->take(look);
        if (watch_->result()) conclude(*watch_->result());
    } catch (const Error& error) {
        watch_.reset();
        answered_ = mapping_->doubts();
        say(fmt::format("Where the projector's light falls could not be checked: {}.", error.what()), false);
    }
}

void ProjectorDesk::begin_watch(const TableLook& look) {
    unshown_ = 0;
    const ProjectorModel shown =
        stretched(*mapping_->model(), screen_.size_px.width_px, screen_.size_px.height_px);
    watch_.emplace(shown, look, config_.check_mm);
}

/// Somebody came: the scene is back at once.
void ProjectorDesk::put_off_watch() {
    quiet_ = 0;
    if (!watch_) return;
    watch_.reset();
    if (++put_off_ < most_put_off) return;
    say("Where the projector's light falls could not be checked: somebody is always over the table.", false);
    answered_ = mapping_->doubts();
    put_off_ = 0;
}

void ProjectorDesk::conclude(const ProjectorCheck& check) {
    watch_.reset();
    answered_ = mapping_->doubts();
    quiet_ = put_off_ = 0;
    const bool is_right = check.verdict == CheckVerdict::right;
    const bool is_measured = is_right || check.verdict == CheckVerdict::off;
    off_mm_ = is_measured ? std::optional(static_cast<double>(check.off_mm)) : std::nullopt;
    say(sentence(describe(check)), is_right);
    if (is_right) size_note_.clear();
    if (check.verdict == CheckVerdict::unseen || check.verdict == CheckVerdict::too_few) return;
    mapping_->answer(is_right ? "" : words_ + " A finger resting in a corner opens the operator's panel.");
}

}  // namespace touchstone
