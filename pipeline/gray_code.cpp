#include "pipeline/gray_code.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

constexpr int white = 0, first_stripes = 2;
constexpr float least_share = 0.6f;  // of the usual number of points, in a cell that is seen whole

int bits_for(int values) { return static_cast<int>(std::bit_width(static_cast<unsigned>(values - 1))); }
unsigned to_gray(unsigned value) { return value ^ (value >> 1); }

unsigned from_gray(unsigned gray) {
    unsigned value = gray;
    while (gray >>= 1) value ^= gray;
    return value;
}

/// The number whose bits, the highest first, a pixel shows from pattern `first` on; -1 where one is not
/// clear.
int read_bits(std::span<const std::vector<float>> seen, std::size_t pixel, int first, int bits,
              float least_contrast) {
    unsigned gray = 0;
    for (int bit = 0; bit < bits; ++bit) {
        const auto stripes = static_cast<std::size_t>(first + 2 * bit);
        const float difference = seen[stripes][pixel] - seen[stripes + 1][pixel];
        if (std::abs(difference) < least_contrast) return -1;
        gray = 2 * gray + (difference > 0.0f ? 1U : 0U);
    }
    return static_cast<int>(from_gray(gray));
}

/// What the camera sees of a cell.
struct CellView {
    Eigen::Vector3f sum_m = Eigen::Vector3f::Zero();
    int points = 0;
};

std::vector<CellView> collect(const GrayCode& code, const CellPicture& cells,
                              std::span<const Eigen::Vector4f> points_g_m) {
    std::vector<CellView> views(static_cast<std::size_t>(code.columns() * code.rows()));
    for (std::size_t pixel = 0; pixel < cells.column.size(); ++pixel) {
        if (cells.column[pixel] < 0 || points_g_m[pixel].w() == 0.0f) continue;
        CellView& view =
            views[static_cast<std::size_t>(cells.row[pixel] * code.columns() + cells.column[pixel])];
        view.sum_m += points_g_m[pixel].head<3>();
        ++view.points;
    }
    return views;
}

/// Of the cells of which anything is seen: the median number of points.
int usual_points(std::span<const CellView> views) {
    std::vector<int> counts;
    for (const CellView& view : views)
        if (view.points > 0) counts.push_back(view.points);
    if (counts.empty()) return 0;
    const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
    std::ranges::nth_element(counts, middle);
    return *middle;
}

}  // namespace

int GrayCode::column_bits() const { return bits_for(columns()); }
int GrayCode::row_bits() const { return bits_for(rows()); }

bool GrayCode::is_lit(int pattern, int x_px, int y_px) const {
    if (pattern < first_stripes) return pattern == white;
    const int stripes = (pattern - first_stripes) / 2;
    const bool inverse = (pattern - first_stripes) % 2 == 1;
    const bool across = stripes < column_bits();
    const int bit = across ? column_bits() - 1 - stripes : row_bits() - 1 - (stripes - column_bits());
    const auto cell = static_cast<unsigned>((across ? x_px : y_px) / cell_px);
    return (((to_gray(cell) >> bit) & 1U) != 0) != inverse;
}

std::vector<std::uint8_t> draw_pattern(const GrayCode& code, int pattern) {
    std::vector<std::uint8_t> picture;
    picture.reserve(static_cast<std::size_t>(code.width_px) * static_cast<std::size_t>(code.height_px));
    for (int y = 0; y < code.height_px; ++y)
        for (int x = 0; x < code.width_px; ++x)
            picture.push_back(code.is_lit(pattern, x, y) ? std::uint8_t{255} : std::uint8_t{0});
    return picture;
}

CellPicture decode_cells(const GrayCode& code, std::span<const std::vector<float>> seen, int width_px,
                         int height_px, const GrayDecodeConfig& config) {
    const std::size_t pixels = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
    const bool fits =
        seen.size() == static_cast<std::size_t>(code.patterns()) &&
        std::ranges::all_of(seen, [&](const auto& picture) { return picture.size() == pixels; });
    if (!fits) throw Error(ExitStatus::bad_data, "the pictures of the stripes are not all of one size");
    CellPicture cells{width_px, height_px, std::vector<int>(pixels, -1), std::vector<int>(pixels, -1), 0};
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        const float contrast = seen[0][pixel] - seen[1][pixel];
        if (contrast < config.least_contrast) continue;
        ++cells.lit;
        const float least = config.least_bit_contrast * contrast;
        const int column = read_bits(seen, pixel, first_stripes, code.column_bits(), least);
        const int row =
            read_bits(seen, pixel, first_stripes + 2 * code.column_bits(), code.row_bits(), least);
        if (column < 0 || row < 0 || column >= code.columns() || row >= code.rows()) continue;
        cells.column[pixel] = column;
        cells.row[pixel] = row;
    }
    return cells;
}

std::vector<ProjectorMatch> match_cells(const GrayCode& code, const CellPicture& cells,
                                        std::span<const Eigen::Vector4f> points_g_m) {
    const std::vector<CellView> views = collect(code, cells, points_g_m);
    const float least = std::max(1.0f, least_share * static_cast<float>(usual_points(views)));
    const auto is_whole = [&](int column, int row) {
        return static_cast<float>(views[static_cast<std::size_t>(row * code.columns() + column)].points) >=
               least;
    };
    std::vector<ProjectorMatch> matches;
    for (int row = 1; row + 1 < code.rows(); ++row) {
        for (int column = 1; column + 1 < code.columns(); ++column) {
            // One whose neighbour is cut off may be cut off, too: its mean is then not that of its middle.
            bool whole = true;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) whole = whole && is_whole(column + dx, row + dy);
            if (!whole) continue;
            const CellView& view = views[static_cast<std::size_t>(row * code.columns() + column)];
            const auto side = static_cast<float>(code.cell_px);
            const Eigen::Vector2f middle_px =
                side * Eigen::Vector2f(static_cast<float>(column), static_cast<float>(row)) +
                Eigen::Vector2f::Constant(0.5f * (side - 1.0f));
            matches.push_back({view.sum_m / static_cast<float>(view.points), middle_px});
        }
    }
    return matches;
}

}  // namespace touchstone
