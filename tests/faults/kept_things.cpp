#include "tests/faults/kept_things.hpp"

#include <cmath>
#include <cstdlib>

#include "app/areas_file.hpp"
#include "app/projector_file.hpp"
#include "app/touch_bias_file.hpp"
#include "pipeline/scan_file.hpp"
#include "ui/painting_file.hpp"

namespace touchstone::test {
namespace {

void save_numbered_scan(const std::filesystem::path& path, int number) {
    SavedScan scan;
    scan.volume.config.size_vox = 64;
    scan.volume.bricks = {1, 5};
    for (int i = 0; i < 2 * BRICK_VOXELS; ++i) scan.volume.voxels.push_back(i * i * (number + 1));
    scan.intrinsics = {575.f, 575.f, 320.f, 240.f, 640, 480, {}};
    scan.T_g_c.translation().x() = static_cast<float>(number);
    save_scan(path, scan);
}

int number_of_scan(const std::filesystem::path& path) {
    return static_cast<int>(load_scan(path).T_g_c.translation().x());
}

void save_numbered_projector(const std::filesystem::path& path, int number) {
    SavedProjector projector;
    projector.model.width_px = 1280;
    projector.model.height_px = 800;
    projector.method = "graycode";
    projector.points = number;
    save_projector(path, projector);
}

void save_numbered_bias(const std::filesystem::path& path, int number) {
    TouchBiasFit fit;
    fit.bias.along_m = 1e-5f * static_cast<float>(number);
    save_touch_bias(path, fit);
}

int number_of_bias(const std::filesystem::path& path) {
    return static_cast<int>(std::lround(1e5 * static_cast<double>(load_touch_bias(path).along_m)));
}

void save_numbered_painting(const std::filesystem::path& path, int number) {
    Painting painting;
    const int stroke = painting.begin({255, 0, 0, 255}, 5.f, false, {0.f, 0.f, 1.f});
    for (int i = 1; i < 200; ++i) painting.extend(stroke, {0.01f * static_cast<float>(i), 0.f, 1.f});
    painting.finish(stroke);
    RigidTransform T_g_c = RigidTransform::Identity();
    T_g_c.translation().x() = static_cast<float>(number);
    save_painting(path, painting, T_g_c);
}

int number_of_painting(const std::filesystem::path& path) {
    const auto stored = load_painting(path);
    if (!stored) throw Error(ExitStatus::no_input, "no painting");
    return static_cast<int>(stored->T_g_c.translation().x());
}

void save_numbered_areas(const std::filesystem::path& path, int number) {
    const auto mm = static_cast<float>(number);
    save_areas(path, {{"left", "paint", "", {{0.f, 0.f}, {5000.f, 0.f}, {5000.f, 6000.f}, {mm, 6000.f}}}});
}

int number_of_areas(const std::filesystem::path& path) {
    const std::vector<NamedArea> areas = load_areas(path);
    if (areas.empty()) throw Error(ExitStatus::no_input, "no areas");
    return static_cast<int>(std::lround(areas[0].corners_mm[3].x()));
}

}  // namespace

std::vector<KeptThing> kept_things() {
    return {{"table.scan", save_numbered_scan, number_of_scan},
            {"projector.calibration", save_numbered_projector,
             [](const std::filesystem::path& path) { return load_projector(path).points; }},
            {"touch.bias", save_numbered_bias, number_of_bias},
            {"table.painting", save_numbered_painting, number_of_painting},
            {"table.areas", save_numbered_areas, number_of_areas, false}};
}

int times(int quick, int full) {
    const char* form = std::getenv("TOUCHSTONE_FAULTS");
    return form != nullptr && std::string(form) == "full" ? full : quick;
}

}  // namespace touchstone::test
