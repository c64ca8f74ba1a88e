#include "app/projector_calibration.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "app/projector_mapping.hpp"
#include "platform/system/error.hpp"
#include "platform/system/log.hpp"

namespace touchstone {
namespace {

constexpr int most_foreground_px = 300;
constexpr int cells_across = 160;
constexpr ProjectorFitConfig touch_fit{.sigma_px = 3.0f, .most_rms_px = 8.0f};

/// What became of the stripes, where the fit alone does not tell.
std::string words_on_stripes(const CellPicture& cells, std::span<const Eigen::Vector4f> points_g_m,
                             const ProjectorFit& fit) {
    if (fit.verdict == ProjectorVerdict::good) return describe(fit);
    const auto pixels = static_cast<double>(cells.column.size());
    const double lit = 100.0 * cells.lit / pixels;
    if (lit < 1.0)
        return "the camera saw nothing of the projector: is it on, does it light what the camera sees, is "
               "the room too bright?";
    const double known =
        100.0 *
        static_cast<double>(std::ranges::count_if(cells.column, [](int column) { return column >= 0; })) /
        pixels;
    const double deep = 100.0 *
                        static_cast<double>(std::ranges::count_if(
                            points_g_m, [](const Eigen::Vector4f& point) { return point.w() > 0.0f; })) /
                        pixels;
    return fmt::format(
        "the projector lights {:.0f} % of the colour picture, its stripes were read in {:.0f} %, "
        "depth is known in {:.0f} %; {}",
        lit, known, deep, describe(fit));
}

}  // namespace

bool TableLook::is_disturbed() const {
    if (seen.state != InteractionState::live) return true;
    return std::ranges::count(pipeline.foreground_map(), std::uint8_t{255}) > most_foreground_px;
}

InteractiveArea TableLook::area_g() const {
    return transformed(pipeline.background()->T_g_c(), *pipeline.area());
}

std::vector<Eigen::Vector4f> TableLook::points_g_m() const {
    const BackgroundModel& background = *pipeline.background();
    return make_surface_grid(background.prediction(), frame.intrinsics, background.T_g_c(), 1).points_g_m;
}

ProjectorCalibration::ProjectorCalibration(CalibrationMethod method, PixelSize projector_px,
                                           const ProjectorCalibrationConfig& config)
    : method_(method), projector_px_(projector_px), config_(config) {}

void ProjectorCalibration::take(const TableLook& look) {
    if (result_) return;
    // A stage puts the next one in its place as the last thing that it does.
    std::visit([&](auto& stage) { take_in(stage, look); }, stage_);
}

void ProjectorCalibration::take_in(QuietStage& quiet, const TableLook& look) {
    const bool is_live = look.seen.state == InteractionState::live;
    const bool disturbed = is_live && look.is_disturbed();
    quiet.quiet = !is_live || disturbed ? 0 : quiet.quiet + 1;
    progress_ = fmt::format("scanning the table: frame {}", ++quiet.frames);
    if (disturbed) show_words("Keep away from the table for a moment");
    if (quiet.quiet >= config_.quiet_frames) {
        begin(look);
    } else if (config_.patience_frames > 0 && quiet.frames > config_.patience_frames) {
        throw Error(ExitStatus::bad_data,
                    "something moves over the table all the time: keep away from it, and try again");
    }
}

void ProjectorCalibration::begin(const TableLook& look) {
    if (method_ == CalibrationMethod::graycode) {
        stage_ = ExposureStage{};
        ThrownPicture white;
        white.gray.assign(static_cast<std::size_t>(projector_px_.width_px * projector_px_.height_px), 255);
        picture_ = std::make_shared<ThrownPicture>(std::move(white));
        return;
    }
    stage_ = ProjectorCrosses(projector_px_.width_px, projector_px_.height_px, look.area_g(),
                              standing_out(look.points_g_m(), look.frame.width_px, look.area_g()));
    show(std::get<ProjectorCrosses>(stage_));
}

void ProjectorCalibration::take_in(ExposureStage& exposure, const TableLook& look) {
    if (look.frame.color_rgb.empty() || ++exposure.frames < config_.exposure_frames) return;
    const int cell_px = std::max(2, (projector_px_.width_px + cells_across - 1) / cells_across);
    const GrayCode code{projector_px_.width_px, projector_px_.height_px, cell_px};
    stage_ = StripesStage{code, PatternSession(code.patterns())};
    show(std::get<StripesStage>(stage_));
}

void ProjectorCalibration::take_in(StripesStage& stripes, const TableLook& look) {
    if (look.frame.color_rgb.empty()) return;
    const bool disturbed = look.is_disturbed();
    if (disturbed && !stripes.session.is_disturbed())
        log_warning("something moves in the view: its patterns are shown again");
    stripes.session.take(look.frame.color_rgb, disturbed);
    const auto pattern = stripes.session.pattern();
    if (!pattern) {
        conclude(stripes, look);
        return;
    }
    progress_ = fmt::format("stripes: {} of {}", *pattern + 1, stripes.code.patterns());
    if (*pattern == stripes.shown) return;
    stripes.shown = *pattern;
    show(stripes);
}

void ProjectorCalibration::show(const StripesStage& stripes) {
    ThrownPicture picture;
    picture.gray = draw_pattern(stripes.code, stripes.session.pattern().value_or(0));
    picture_ = std::make_shared<ThrownPicture>(std::move(picture));
}

void ProjectorCalibration::conclude(const StripesStage& stripes, const TableLook& look) {
    const CellPicture cells =
        decode_cells(stripes.code, stripes.session.seen(), look.frame.width_px, look.frame.height_px);
    const auto points_g_m = look.points_g_m();
    const auto matches = match_cells(stripes.code, cells, points_g_m);
    const ProjectorFit fit =
        fit_projector(matches, projector_px_.width_px, projector_px_.height_px, look.area_g(), {});
    result_ = CalibrationResult{"graycode", fit, words_on_stripes(cells, points_g_m, fit)};
}

void ProjectorCalibration::take_in(ProjectorCrosses& crosses, const TableLook& look) {
    const std::size_t touched = crosses.matches().size();
    const int shown = crosses.shown();
    crosses.take(look.seen.touches, look.pipeline.background()->T_g_c(), look.frame.timestamp_us);
    if (crosses.shown() > shown)
        log_info("cross {} of {}: {}", crosses.shown(), crosses.wanted(),
                 crosses.matches().size() > touched ? "touched" : "passed over");
    progress_ = fmt::format("crosses: {} of {}", crosses.shown(), crosses.wanted());
    if (crosses.cross_px())
        show(crosses);
    else
        conclude(crosses, look);
}

void ProjectorCalibration::show(const ProjectorCrosses& crosses) {
    ThrownPicture picture;
    picture.cross_px = crosses.cross_px();
    picture.words = fmt::format("{}  {} of {}", crosses.words(), crosses.shown() + 1, crosses.wanted());
    const bool is_same = picture_->cross_px == picture.cross_px && picture_->words == picture.words;
    if (!is_same) picture_ = std::make_shared<ThrownPicture>(std::move(picture));
}

void ProjectorCalibration::conclude(const ProjectorCrosses& crosses, const TableLook& look) {
    const ProjectorFit fit = fit_projector(crosses.matches(), projector_px_.width_px, projector_px_.height_px,
                                           look.area_g(), touch_fit);
    result_ = CalibrationResult{"touch", fit, describe(fit)};
}

void ProjectorCalibration::show_words(const std::string& words) {
    if (picture_->words == words) return;
    ThrownPicture picture;
    picture.words = words;
    picture_ = std::make_shared<ThrownPicture>(std::move(picture));
}

}  // namespace touchstone
