#include "app/configuration_checks.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <unistd.h>

#include "app/area_scenes.hpp"
#include "app/configured_camera.hpp"
#include "app/machine_checks.hpp"
#include "app/photo_folder.hpp"
#include "platform/camera/sensor_models.hpp"
#include "platform/mesh/mesh_file.hpp"
#include "platform/system/atomic_file.hpp"

namespace touchstone {
namespace {

namespace fs = std::filesystem;

/// Adds a line where `look` throws.
void add_fault(std::vector<CheckLine>& lines, const std::string& key, const std::string& advice,
               const std::function<void()>& look) {
    try {
        look();
    } catch (const Error& error) {
        lines.push_back(
            {"configuration", CheckStatus::fail, fmt::format("{}: {}", key, error.what()), advice});
    }
}

void add_unwritable(std::vector<CheckLine>& lines, const std::string& key, const std::string& file) {
    if (file.empty()) return;
    add_fault(lines, key, "make the folder, or name another file; nothing is kept there as it is",
              [&] { check_writable(file); });
}

/// A folder that is made when something is to be written into it.
void add_unmakeable(std::vector<CheckLine>& lines, const std::string& key, const std::string& folder) {
    if (folder.empty()) return;
    add_fault(lines, key, "name another folder; nothing is written there as it is", [&] {
        const fs::path place = existing_part(folder);
        std::error_code none;
        if (!fs::is_directory(place, none) || access(place.c_str(), W_OK | X_OK) != 0)
            throw Error(ExitStatus::io_error, "no folder " + folder + " can be made in " + place.string());
    });
}

void check_photos(std::vector<CheckLine>& lines, const std::string& folder) {
    std::error_code none;
    const std::string advice = "put PNG or JPEG into it, or leave the key out";
    if (!fs::is_directory(folder, none))
        lines.push_back({"configuration", CheckStatus::fail, "display.photos: no folder " + folder, advice});
    else if (open_photo_folder(folder).count == 0)
        lines.push_back(
            {"configuration", CheckStatus::warn, "display.photos: no pictures in " + folder, advice});
}

void check_areas(std::vector<CheckLine>& lines, const Config& config) {
    std::error_code none;
    if (!fs::exists(config.areas_file, none)) {
        lines.push_back(
            {"configuration", CheckStatus::warn,
             fmt::format("areas.file: no file {} yet, the table is not divided", config.areas_file),
             "draw areas from the operator's panel, or write it"});
        return;
    }
    add_fault(lines, "areas.file", "mend it; the table is not divided as it is",
              [&] { (void)load_areas_with_scenes(config.areas_file, config.display.scene, false); });
}

}  // namespace

std::vector<CheckLine> check_named_files(const Config& config) {
    std::vector<CheckLine> lines;
    const std::string& models = config.sensor_models;
    if (!models.empty())
        add_fault(lines, "sensor.models", "mend or name another", [&] { (void)load_sensor_models(models); });
    if (!config.display.photos.empty()) check_photos(lines, config.display.photos);
    if (!config.display.model.empty())
        add_fault(lines, "display.model", "name another mesh, or leave the key out",
                  [&] { (void)read_mesh_file(config.display.model, MeshDetail::look); });
    if (!config.areas_file.empty()) check_areas(lines, config);
    std::error_code none;
    if (!config.object_file.empty() && !fs::exists(config.object_file, none))
        lines.push_back({"configuration", CheckStatus::fail, "objects.model: no file " + config.object_file,
                         "touchstone track --scan makes one; or leave the key out"});
    add_unmakeable(lines, "objects.export_dir", config.interaction.background.objects.export_dir);
    add_unmakeable(lines, "health.fault_dir", config.fault_reports.dir);
    add_unwritable(lines, "scan.file", config.scan_file);
    add_unwritable(lines, "areas.file", config.areas_file);
    add_unwritable(lines, "touch.bias_file", config.bias_file);
    add_unwritable(lines, "display.painting_file", config.display.painting_file);
    add_unwritable(lines, "projector.file", config.projector.file);
    return lines;
}

std::vector<CheckLine> check_named_source(const Config& config) {
    const std::string& uri = config.sensor_uri;
    if (uri.empty()) return {};
    try {
        const DepthCamera camera = configured_camera(config, std::nullopt, false);
        return {{"sensor",
                 CheckStatus::ok,
                 fmt::format("{}, named by the configuration, gives {}x{} at {:.0f} Hz", uri,
                             camera.intrinsics().width_px, camera.intrinsics().height_px, camera.rate_hz()),
                 {}}};
    } catch (const Error& error) {
        return {{"sensor", CheckStatus::fail,
                 fmt::format("{}, named by the configuration: {}", uri, error.what()),
                 "mend sensor.uri, or leave it out for the camera that is plugged in"}};
    }
}

}  // namespace touchstone
