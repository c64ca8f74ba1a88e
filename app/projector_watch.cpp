#include "app/projector_watch.hpp"

#include <utility>

namespace touchstone {
namespace {

constexpr PatternSessionConfig quick{.settle_frames = 4, .frames_per_pattern = 2};

std::shared_ptr<const ThrownPicture> picture_of(std::vector<std::uint8_t> gray) {
    ThrownPicture picture;
    picture.gray = std::move(gray);
    return std::make_shared<ThrownPicture>(std::move(picture));
}

}  // namespace

ProjectorWatch::ProjectorWatch(const ProjectorModel& model, const TableLook& look, float limit_mm)
    : model_(model),
      limit_mm_(limit_mm),
      squares_(choose_squares(model, look.points_g_m(), look.frame.width_px, look.area_g())),
      session_(squares_.patterns(), quick) {
    picture_ = picture_of(
        std::vector<std::uint8_t>(static_cast<std::size_t>(model.width_px * model.height_px), 255));
}

void ProjectorWatch::take(const TableLook& look) {
    if (result_ || look.frame.color_rgb.empty()) return;
    if (exposed_ < exposure_frames) {
        if (++exposed_ == exposure_frames) show(0);
        return;
    }
    session_.take(look.frame.color_rgb, false);
    const auto pattern = session_.pattern();
    if (!pattern)
        conclude(look);
    else if (*pattern != shown_)
        show(*pattern);
}

void ProjectorWatch::show(int pattern) {
    shown_ = pattern;
    picture_ = picture_of(draw_pattern(squares_, pattern));
}

void ProjectorWatch::conclude(const TableLook& look) {
    const SeenSquares seen = find_squares(squares_, session_.seen(), look.points_g_m(), look.frame.width_px);
    result_ =
        judge_squares(model_, static_cast<int>(squares_.corners_px.size()), seen, look.area_g(), limit_mm_);
}

}  // namespace touchstone
