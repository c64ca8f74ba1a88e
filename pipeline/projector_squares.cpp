#include "pipeline/projector_squares.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;
using Eigen::Vector2i;
using Eigen::Vector3f;
using Eigen::Vector4f;

constexpr int squares_across = 4, squares_down = 3;
constexpr float inset = 0.14f;           // of the area: the outermost squares' middles lie so far inside
constexpr int sides_per_width = 40;      // a square is so small a part of the picture's width
constexpr float nearest_uv = 0.09f;      // a place farther from where it is wanted is none
constexpr int look_px = 6, reach = 2;    // steps around a place in which the surface must be even
constexpr float even_m = 0.005f;         // off the middle of what lies on both sides
constexpr float least_contrast = 12.0f;  // lit over dark, grey levels
constexpr float edge_share = 0.5f;       // of a spot's brightest: darker pixels are its edge
constexpr int least_pixels = 24;
constexpr float least_known = 0.8f;  // of a spot's pixels have a point
constexpr int least_squares = 3;     // of which a median is taken

/// On the surface, with nothing steep around; nothing where that is not so.
std::optional<Vector3f> even_point(std::span<const Vector4f> points_g_m, int width_px, int x_px, int y_px) {
    const auto point = [&](int x, int y) { return points_g_m[static_cast<std::size_t>(y * width_px + x)]; };
    const Vector4f middle = point(x_px, y_px);
    if (middle.w() == 0.0f) return std::nullopt;
    for (int step = 1; step <= reach; ++step) {
        const int far = step * look_px;
        for (const auto& [dx, dy] :
             std::array<std::array<int, 2>, 4>{{{far, 0}, {0, far}, {far, far}, {far, -far}}}) {
            const Vector4f a = point(x_px - dx, y_px - dy), b = point(x_px + dx, y_px + dy);
            if (a.w() == 0.0f || b.w() == 0.0f) return std::nullopt;
            if ((0.5f * (a + b) - middle).norm() > even_m) return std::nullopt;
        }
    }
    return Vector3f(middle.head<3>());
}

std::optional<Vector3f> even_point_near(std::span<const Vector4f> points_g_m, int width_px,
                                        const InteractiveArea& area_g, const Vector2f& wanted_uv) {
    const int height_px = static_cast<int>(points_g_m.size()) / width_px;
    const int free_px = reach * look_px;
    float least = nearest_uv;
    std::optional<Vector3f> nearest;
    for (int y = free_px; y + free_px < height_px; y += look_px) {
        for (int x = free_px; x + free_px < width_px; x += look_px) {
            const Vector4f& point = points_g_m[static_cast<std::size_t>(y * width_px + x)];
            if (point.w() == 0.0f) continue;
            const float distance = (area_uv(area_g, point.head<3>()) - wanted_uv).norm();
            if (distance >= least) continue;
            if (const auto even = even_point(points_g_m, width_px, x, y)) {
                nearest = even;
                least = distance;
            }
        }
    }
    return nearest;
}

/// Pixels of a camera that are lit together.
using Spot = std::vector<std::size_t>;

std::vector<Spot> find_spots(const std::vector<float>& light, int width_px) {
    const auto width = static_cast<std::size_t>(width_px);
    std::vector<bool> taken(light.size(), false);
    std::vector<Spot> spots;
    for (std::size_t start = 0; start < light.size(); ++start) {
        if (taken[start] || light[start] < least_contrast) continue;
        Spot spot{start};
        taken[start] = true;
        for (std::size_t next = 0; next < spot.size(); ++next) {
            const std::size_t at = spot[next], x = at % width;
            const auto visit = [&](bool there, std::size_t neighbour) {
                if (!there || taken[neighbour] || light[neighbour] < least_contrast) return;
                taken[neighbour] = true;
                spot.push_back(neighbour);
            };
            visit(x > 0, at - 1);
            visit(x + 1 < width, at + 1);
            visit(at >= width, at - width);
            visit(at + width < light.size(), at + width);
        }
        if (static_cast<int>(spot.size()) >= least_pixels) spots.push_back(std::move(spot));
    }
    return spots;
}

/// Without the edge, which is lit in part.
Spot core_of(const Spot& spot, const std::vector<float>& light) {
    float brightest = 0.0f;
    for (const std::size_t pixel : spot) brightest = std::max(brightest, light[pixel]);
    Spot core;
    std::ranges::copy_if(spot, std::back_inserter(core),
                         [&](std::size_t pixel) { return light[pixel] > edge_share * brightest; });
    return core;
}

/// One that the picture's edge cuts has its middle elsewhere.
bool is_cut(const Spot& spot, int width_px, std::size_t pixels) {
    const auto width = static_cast<std::size_t>(width_px);
    return std::ranges::any_of(spot, [&](std::size_t at) {
        return at % width == 0 || at % width == width - 1 || at < width || at + width >= pixels;
    });
}

float mean_of(const Spot& spot, const std::vector<float>& picture) {
    float sum = 0.0f;
    for (const std::size_t pixel : spot) sum += picture[pixel];
    return sum / static_cast<float>(spot.size());
}

/// By when it was lit; nothing for a number that no square has.
std::optional<int> square_of(const ProjectorSquares& squares, std::span<const std::vector<float>> seen,
                             const Spot& spot) {
    const float dark = mean_of(spot, seen[0]), lit = mean_of(spot, seen[1]);
    unsigned number = 0;
    for (int bit = 0; bit < squares.bits(); ++bit)
        if (mean_of(spot, seen[static_cast<std::size_t>(2 + bit)]) > 0.5f * (dark + lit)) number |= 1U << bit;
    const int square = static_cast<int>(number) - 1;
    return square >= 0 && square < static_cast<int>(squares.corners_px.size()) ? std::optional(square)
                                                                               : std::nullopt;
}

std::optional<Vector3f> place_of(const Spot& spot, std::span<const Vector4f> points_g_m) {
    Vector4f sum = Vector4f::Zero();
    for (const std::size_t pixel : spot) sum += points_g_m[pixel];
    if (sum.w() < least_known * static_cast<float>(spot.size())) return std::nullopt;
    return Vector3f(sum.head<3>() / sum.w());
}

float median_of(std::vector<float> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

}  // namespace

int ProjectorSquares::bits() const {
    return static_cast<int>(std::bit_width(static_cast<unsigned>(corners_px.size())));
}

/// Numbers begin with 1: each square is lit at least once more.
bool ProjectorSquares::is_lit(int pattern, int square) const {
    if (pattern < 2) return pattern == 1;
    return ((static_cast<unsigned>(square + 1) >> (pattern - 2)) & 1U) != 0;
}

Vector2f ProjectorSquares::middle_px(int square) const {
    const float half = 0.5f * static_cast<float>(side_px - 1);
    return corners_px[static_cast<std::size_t>(square)].cast<float>() + Vector2f(half, half);
}

ProjectorSquares choose_squares(const ProjectorModel& model, std::span<const Vector4f> points_g_m,
                                int camera_width_px, const InteractiveArea& area_g) {
    ProjectorSquares squares{model.width_px, model.height_px, std::max(4, model.width_px / sides_per_width)};
    const auto place = [](int index, int count) {
        return inset + (1.0f - 2.0f * inset) * static_cast<float>(index) / static_cast<float>(count - 1);
    };
    for (int row = 0; row < squares_down; ++row) {
        for (int column = 0; column < squares_across; ++column) {
            const auto point_g_m = even_point_near(points_g_m, camera_width_px, area_g,
                                                   {place(column, squares_across), place(row, squares_down)});
            const auto at_px = point_g_m ? project(model, *point_g_m) : std::nullopt;
            if (!at_px) continue;
            const float half = 0.5f * static_cast<float>(squares.side_px);
            const Vector2i corner(static_cast<int>(std::lround(at_px->x() - half)),
                                  static_cast<int>(std::lround(at_px->y() - half)));
            const bool inside = corner.minCoeff() >= 0 && corner.x() + squares.side_px <= model.width_px &&
                                corner.y() + squares.side_px <= model.height_px;
            if (inside) squares.corners_px.push_back(corner);
        }
    }
    return squares;
}

std::vector<std::uint8_t> draw_pattern(const ProjectorSquares& squares, int pattern) {
    std::vector<std::uint8_t> gray(static_cast<std::size_t>(squares.width_px * squares.height_px), 0);
    for (std::size_t square = 0; square < squares.corners_px.size(); ++square) {
        if (!squares.is_lit(pattern, static_cast<int>(square))) continue;
        const Vector2i& corner = squares.corners_px[square];
        for (int y = corner.y(); y < corner.y() + squares.side_px; ++y)
            std::fill_n(gray.begin() + y * squares.width_px + corner.x(), squares.side_px, std::uint8_t{255});
    }
    return gray;
}

SeenSquares find_squares(const ProjectorSquares& squares, std::span<const std::vector<float>> seen,
                         std::span<const Vector4f> points_g_m, int camera_width_px) {
    const bool fits = static_cast<int>(seen.size()) == squares.patterns() &&
                      std::ranges::all_of(seen, [&](const std::vector<float>& picture) {
                          return picture.size() == points_g_m.size();
                      });
    if (!fits) throw Error(ExitStatus::bad_data, "pictures of squares do not fit their patterns");
    std::vector<float> light(points_g_m.size());
    for (std::size_t i = 0; i < light.size(); ++i) light[i] = seen[1][i] - seen[0][i];
    const std::vector<Spot> spots = find_spots(light, camera_width_px);
    SeenSquares found{static_cast<int>(spots.size()), {}};
    for (const Spot& spot : spots) {
        const Spot core = core_of(spot, light);
        if (is_cut(spot, camera_width_px, light.size()) || static_cast<int>(core.size()) < least_pixels)
            continue;
        const auto square = square_of(squares, seen, core);
        const auto place = place_of(core, points_g_m);
        if (square && place) found.matches.push_back({*place, squares.middle_px(*square)});
    }
    return found;
}

ProjectorCheck judge_squares(const ProjectorModel& model, int shown, const SeenSquares& seen,
                             const InteractiveArea& area_g, float limit_mm) {
    ProjectorCheck check;
    check.shown = shown;
    check.found = static_cast<int>(seen.matches.size());
    if (shown < least_squares) {
        check.verdict = CheckVerdict::too_few;
        return check;
    }
    if (check.found < least_squares) {
        check.verdict = seen.lights > 0 ? CheckVerdict::beside : CheckVerdict::unseen;
        return check;
    }
    std::vector<float> off_mm, off_px;
    for (const ProjectorMatch& match : seen.matches) {
        const auto at_px = project(model, match.point_g_m);
        off_px.push_back(at_px ? (*at_px - match.pixel_px).norm() : INFINITY);
        off_mm.push_back(at_px ? 1000.0f * static_cast<float>(light_off_m(model, match, area_g)) : INFINITY);
    }
    check.off_mm = median_of(std::move(off_mm));
    check.off_px = median_of(std::move(off_px));
    check.verdict = check.off_mm <= limit_mm ? CheckVerdict::right : CheckVerdict::off;
    return check;
}

std::string describe(const ProjectorCheck& check) {
    switch (check.verdict) {
        case CheckVerdict::right:
            return fmt::format(
                "the projector's light falls right: {:.1f} mm ({:.1f} pixels) off, by {} squares",
                check.off_mm, check.off_px, check.found);
        case CheckVerdict::off:
            return fmt::format(
                "the projector's light falls {:.0f} mm ({:.0f} pixels) off: calibrate it again", check.off_mm,
                check.off_px);
        case CheckVerdict::beside:
            return "the projector's light falls beside where it should: calibrate it again";
        case CheckVerdict::too_few:
            return "by its calibration the projector lights too little of the table to check it";
        case CheckVerdict::unseen:
            break;
    }
    return "the camera saw no light of the projector: is it on, is the room too bright?";
}

}  // namespace touchstone
