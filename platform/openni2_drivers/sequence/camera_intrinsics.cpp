#include "platform/openni2_drivers/sequence/camera_intrinsics.hpp"

#include <array>
#include <cmath>
#include <fmt/core.h>
#include <fstream>
#include <string>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

bool is_pinhole(const std::array<double, 9>& k) {
    for (const double value : k) {
        if (!std::isfinite(value)) return false;
    }
    return k[0] > 0 && k[1] == 0 && k[3] == 0 && k[4] > 0 && k[6] == 0 && k[7] == 0 && k[8] == 1;
}

}  // namespace

Intrinsics read_intrinsics(const std::filesystem::path& path, int width_px, int height_px) {
    std::ifstream file(path);
    std::array<double, 9> k{};
    bool complete = true;
    for (double& value : k) complete = complete && (file >> value);
    std::string rest;
    if (!complete || file >> rest || !is_pinhole(k)) {
        throw Error(
            ExitStatus::bad_data,
            fmt::format("{}: expected the 9 numbers fx 0 cx  0 fy cy  0 0 1 in pixels", path.string()));
    }
    return {static_cast<float>(k[0]),
            static_cast<float>(k[4]),
            static_cast<float>(k[2]),
            static_cast<float>(k[5]),
            width_px,
            height_px,
            {}};
}

Intrinsics default_intrinsics(int width_px, int height_px) {
    const float scale_x = static_cast<float>(width_px) / 640.0F;
    const float scale_y = static_cast<float>(height_px) / 480.0F;
    // Pixel centres are whole numbers: the picture's edge, not its first pixel, is what scales.
    return {575.8F * scale_x,
            575.8F * scale_y,
            320.0F * scale_x - 0.5F,
            240.0F * scale_y - 0.5F,
            width_px,
            height_px,
            {}};
}

}  // namespace touchstone
