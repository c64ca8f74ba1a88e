#include "tests/accuracy/projector_run.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <vector>

#include "app/projector_file.hpp"
#include "platform/image/png_file.hpp"
#include "platform/openni2_drivers/simulator/projector.hpp"
#include "platform/openni2_drivers/simulator/scene.hpp"
#include "platform/openni2_drivers/simulator/simulator_config.hpp"
#include "platform/openni2_drivers/simulator/simulator_source.hpp"
#include "platform/openni2_drivers/simulator/static_layer.hpp"
#include "platform/system/error.hpp"
#include "platform/system/percentile.hpp"
#include "platform/system/projected_picture.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

constexpr double finger_reach_mm = 30.0, contact_gap_mm = 1.0;

/// The table as it is, and the light on it.
class TrueTable {
  public:
    explicit TrueTable(const ProjectorRun& run)
        : config_(parse_simulator_uri(fmt::format("{}?seed={}&projector=1", run.scene, run.seed))),
          view_(sim::make_table_view(config_.height_m, config_.tilt_deg)),
          scene_(sim::make_scene(config_.scene, config_.seed, view_.on_table(639.0F, 239.5F).x())),
          projector_(sim::make_projector(view_, config_.seed)) {}

    std::vector<Eigen::Vector3f> points_c_m() const {
        constexpr int step_px = 12, edge_px = 24;
        const std::vector<float> depth_m = sim::render_static_depth(scene_, view_);
        std::vector<Eigen::Vector3f> points;
        for (int y = edge_px; y < 480 - edge_px; y += step_px)
            for (int x = edge_px; x < 640 - edge_px; x += step_px)
                points.push_back(view_.ray_c(static_cast<float>(x), static_cast<float>(y)) *
                                 depth_m[static_cast<std::size_t>(640 * y + x)]);
        return points;
    }

    /// Between a point and where the light falls that a calibrated projector sends to `aimed_c_m`; none where
    /// that is beyond the picture, or where something stands in the light of the point.
    std::optional<double> error_mm(const ProjectorModel& model, const Eigen::Vector3f& aimed_c_m,
                                   const Eigen::Vector3f& wanted_c_m) const {
        const Eigen::Vector3f wanted_s = view_.to_scene(wanted_c_m);
        const auto pixel = project(model, aimed_c_m);
        if (!pixel || pixel->x() < 0.0F || pixel->y() < 0.0F ||
            pixel->x() > static_cast<float>(model.width_px - 1) ||
            pixel->y() > static_cast<float>(model.height_px - 1))
            return std::nullopt;
        const auto lit_s =
            sim::first_hit(scene_, projector_.position_s, projector_.ray_s(*pixel).normalized());
        if (!lit_s || is_in_shadow(wanted_s)) return std::nullopt;
        return 1000.0 * static_cast<double>((*lit_s - wanted_s).norm());
    }

  private:
    bool is_in_shadow(const Eigen::Vector3f& point_s) const {
        constexpr float grazing_m = 0.005F;
        const Eigen::Vector3f way = point_s - projector_.position_s;
        const auto first = sim::first_hit(scene_, projector_.position_s, way.normalized());
        return first && (*first - projector_.position_s).norm() < way.norm() - grazing_m;
    }

    SimulatorConfig config_;
    sim::TableView view_;
    sim::Scene scene_;
    sim::Projector projector_;
};

double mean_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

Eigen::Vector3f point_m(const json& mm) {
    return 0.001F * Eigen::Vector3f(mm.at(0).get<float>(), mm.at(1).get<float>(), mm.at(2).get<float>());
}

void check(const test::ProgramResult& result) {
    if (result.status != 0) throw Error(ExitStatus::bad_data, result.err);
}

/// The finger in contact at a frame that is nearest to a place.
std::optional<Eigen::Vector3f> true_contact_c_m(const json& tips, const Eigen::Vector3f& place_c_m) {
    std::optional<Eigen::Vector3f> nearest;
    double least_mm = finger_reach_mm;
    for (const json& tip : tips) {
        if (tip.at("gap_mm").get<double>() > contact_gap_mm) continue;
        const Eigen::Vector3f at = point_m(tip.at("camera_mm"));
        const double distance_mm = 1000.0 * static_cast<double>((at - place_c_m).norm());
        if (distance_mm >= least_mm) continue;
        least_mm = distance_mm;
        nearest = at;
    }
    return nearest;
}

/// One error for each frame of each touch whose finger is truly in contact.
std::vector<double> touch_errors_mm(const ProjectorRun& run, const TrueTable& table,
                                    const ProjectorModel& model, const std::filesystem::path& truth_file,
                                    const std::filesystem::path& config_file) {
    const std::string sensor = fmt::format("sim:{}?seed={}&hands=2&frames={}&truth={}", run.scene, run.seed,
                                           run.touch_frames, truth_file.string());
    const test::ProgramResult result =
        test::run_program({run.program, "run", "--config", config_file.string(), "--sensor", sensor, "--pace",
                           "step", "--display", "headless", "--scene", "attract", "--events", "-"});
    check(result);
    std::ifstream file(truth_file);
    const json truth = json::parse(file);
    std::vector<double> errors;
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) {
        const json event = json::parse(line);
        for (const json& touch : event.at("touches")) {
            if (touch.at("phase") == "up") continue;
            const Eigen::Vector3f said = point_m(touch.at("camera_mm"));
            const auto contact =
                true_contact_c_m(truth.at("tips").at(event.at("frame").get<std::size_t>()), said);
            if (!contact) continue;
            if (const auto error = table.error_mm(model, said, *contact)) errors.push_back(*error);
        }
    }
    return errors;
}

/// Shows a scene on the table without hands, as the projector throws it and as the colour camera sees it.
void save_pictures(const ProjectorRun& run, const std::filesystem::path& config_file,
                   const std::filesystem::path& shots) {
    constexpr int frames = 60;
    const std::string sensor =
        fmt::format("sim:{}?projector=1&seed={}&hands=0&ambient=0.5", run.scene, run.seed);
    check(test::run_program({run.program, "run", "--config", config_file.string(), "--sensor", sensor,
                             "--pace", "step", "--frames", std::to_string(frames), "--scene", "photos",
                             "--shots", shots.string()}));
    const Image8 thrown = read_png_8(shots / fmt::format("frame-{:06}.png", frames - 1));
    ProjectedPictureWriter writer(projected_picture_name(), thrown.width_px, thrown.height_px);
    writer.show(thrown.pixels, thrown.width_px, thrown.height_px);
    const std::unique_ptr<FrameSource> table = open_simulator(sensor.substr(4));
    table->enable_color(true);
    SourceFrame seen;
    table->next(seen);
    const std::filesystem::path folder = run.pictures;
    std::filesystem::create_directories(folder);
    const std::string name = fmt::format("{}-{}-{}", run.scene, run.seed, run.method);
    write_png(folder / (name + "-thrown.png"), thrown);
    write_png(folder / (name + "-seen.png"), Image8{640, 480, 3, seen.color_rgb});
}

/// "looked at 312 frames" of the log.
int frames_said(const std::string& log) {
    constexpr std::string_view words = "looked at ";
    const std::size_t at = log.find(words);
    return at == std::string::npos ? 0 : std::stoi(log.substr(at + words.size()));
}

}  // namespace

ProjectorScore run_projector(const ProjectorRun& run) {
    const TemporaryFolder folder;
    const std::filesystem::path config_file = folder / "table.toml", calibration = folder / "projector";
    std::ofstream(config_file) << "[projector]\nfile = \"" << calibration.string()
                               << "\"\n[tuio]\nenabled = false\n";
    const bool by_touch = run.method == "touch";
    const std::string sensor = fmt::format("sim:{}?projector=1&seed={}{}{}", run.scene, run.seed,
                                           by_touch ? "&hands=1&guided=1" : "&hands=0", run.keys);
    const test::ProgramResult result =
        test::run_program({run.program, "calibrate", "--config", config_file.string(), "--sensor", sensor,
                           "--pace", "step", "--method", run.method, "--json", "-"});
    check(result);
    const json said = json::parse(result.out);
    ProjectorScore score;
    score.model = said.at("model").get<std::string>();
    score.verdict = said.at("verdict").get<std::string>();
    score.rms_px = said.at("rms_px").get<double>();
    score.points = said.at("points").get<int>();
    score.frames = frames_said(result.err);
    const ProjectorModel model = load_projector(calibration).model;
    const TrueTable table(run);
    std::vector<double> errors;
    for (const Eigen::Vector3f& point : table.points_c_m())
        if (const auto error = table.error_mm(model, point, point)) errors.push_back(*error);
    score.mean_mm = mean_of(errors);
    score.p95_mm = percentile(errors, 95.0);
    if (!run.pictures.empty()) save_pictures(run, config_file, folder / "shots");
    if (run.touch_frames == 0) return score;
    const auto touches = touch_errors_mm(run, table, model, folder / "truth.json", config_file);
    score.touches = static_cast<int>(touches.size());
    score.touch_mean_mm = mean_of(touches);
    score.touch_p95_mm = percentile(touches, 95.0);
    return score;
}

}  // namespace touchstone
