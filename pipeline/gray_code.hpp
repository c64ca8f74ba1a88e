#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/projector_fit.hpp"

namespace touchstone {

/// Stripes that tell the cell of the projector's picture that lights a place: white, black, then for each bit
/// of the column, and after those of the row, the stripes and their inverse (Inokuchi et al. 1984; the
/// inverse tells light from dark whatever the colour of the surface and the light of the room).
struct GrayCode {
    int width_px = 0, height_px = 0;
    /// Side of a cell. A camera's pixel should see less than half of it: its middle is then known better than
    /// its side, as the mean of what the camera sees of it.
    int cell_px = 8;

    int columns() const { return (width_px + cell_px - 1) / cell_px; }
    int rows() const { return (height_px + cell_px - 1) / cell_px; }
    int column_bits() const;
    int row_bits() const;
    int patterns() const { return 2 + 2 * (column_bits() + row_bits()); }
    /// Whether a pixel of the projector is white in a pattern.
    bool is_lit(int pattern, int x_px, int y_px) const;
};

/// Grey, 0 or 255 a pixel, row-major, row 0 at the top.
std::vector<std::uint8_t> draw_pattern(const GrayCode& code, int pattern);

struct GrayDecodeConfig {
    float least_contrast = 12.0f;     ///< white over black, grey levels
    float least_bit_contrast = 0.2f;  ///< of a stripe over its inverse, as a share of white over black
};

/// Which cell lights each pixel of a camera that saw all patterns.
struct CellPicture {
    int width_px = 0, height_px = 0;
    std::vector<int> column, row;  ///< row-major; -1 both where none is known
    int lit = 0;                   ///< pixels in which white was brighter than black
};

/// `seen`: one grey picture a pattern, in their order, each width x height, row-major. Throws Error{bad_data}
/// for another number or size.
CellPicture decode_cells(const GrayCode& code, std::span<const std::vector<float>> seen, int width_px,
                         int height_px, const GrayDecodeConfig& config = {});

/// One match for each cell that is seen whole: its middle, and the mean of its points. `points_g_m`: of each
/// pixel, x, y, z, 1; all 0 where there is none.
std::vector<ProjectorMatch> match_cells(const GrayCode& code, const CellPicture& cells,
                                        std::span<const Eigen::Vector4f> points_g_m);

}  // namespace touchstone
