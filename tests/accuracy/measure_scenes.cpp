// measure_scenes [--frames N] [--endure MINUTES] [--pictures DIR] [--scene NAME]: what each scene costs a
// frame of 1280 x 720 without a screen, scripted people at work, as a table.
#include <CLI/CLI.hpp>
#include <GLES3/gl31.h>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <fmt/core.h>

#include "platform/display/gl_error.hpp"
#include "platform/display/headless_display.hpp"
#include "platform/image/png_file.hpp"
#include "platform/system/error.hpp"
#include "platform/system/percentile.hpp"
#include "platform/system/process_memory.hpp"
#include "tests/accuracy/scene_visit.hpp"
#include "ui/scene_list.hpp"
#include "ui/table_presenter.hpp"

namespace touchstone {
namespace {

constexpr PixelSize display_size{1280, 720};
constexpr float dt_s = 1.f / 30.f;
constexpr int warm_up_frames = 30, picture_every = 150;

struct Options {
    int frames = 600;
    double endure_min = 0.0;
    std::string pictures, scene;
};

struct SceneFigures {
    std::vector<double> frame_ms;  // by the clock
    double cpu_ms = 0.0;           // a frame, of all threads: what a busy machine does not change
    std::string gl_errors;
    double grown_mb = 0.0;
};

double cpu_ms_so_far() { return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double milliseconds_of(TablePresenter& presenter, const TableFrame& frame) {
    glFinish();
    const auto start = std::chrono::steady_clock::now();
    presenter.present(frame, dt_s);
    glFinish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void save_picture(Display& display, const Options& options, const std::string& scene, int frame) {
    if (options.pictures.empty() || frame % picture_every != 0) return;
    const Picture shown = display.read_pixels();
    write_png(std::filesystem::path(options.pictures) / fmt::format("{}-{:04}.png", scene, frame),
              Image8{shown.width_px, shown.height_px, 4, shown.rgba});
}

SceneFigures measure(const std::string& scene, const Options& options) {
    const auto display = make_headless_display(display_size);
    PresenterConfig config;
    config.menu = true;
    TablePresenter presenter(*display, scene, config);
    SceneVisit visit;
    SceneFigures figures;
    const auto start = std::chrono::steady_clock::now();
    const auto minutes = [&] {
        return std::chrono::duration<double, std::ratio<60>>(std::chrono::steady_clock::now() - start)
            .count();
    };
    double settled_mb = 0.0, cpu_ms = 0.0;
    int frames_done = 0;
    for (int i = 0; i < options.frames + warm_up_frames || minutes() < options.endure_min; ++i) {
        const TableFrame frame = visit.next(presenter.wish());
        const double cpu_before_ms = cpu_ms_so_far();
        const double ms = milliseconds_of(presenter, frame);
        cpu_ms += cpu_ms_so_far() - cpu_before_ms;
        frames_done = i + 1;
        if (i >= warm_up_frames && figures.frame_ms.size() < 100'000) figures.frame_ms.push_back(ms);
        if (settled_mb == 0.0 && i >= options.frames / 2 && minutes() >= 0.2 * options.endure_min)
            settled_mb = resident_mb();
        if (figures.gl_errors.empty()) figures.gl_errors = take_gl_errors();
        save_picture(*display, options, scene, i);
    }
    figures.cpu_ms = cpu_ms / frames_done;
    figures.grown_mb = resident_mb() - settled_mb;
    return figures;
}

void print(const std::string& scene, const SceneFigures& figures) {
    fmt::print("{:<12}{:>10.2f}{:>10.2f}{:>10.2f}{:>12}{:>12.2f}\n", scene, percentile(figures.frame_ms, 50),
               percentile(figures.frame_ms, 99), figures.cpu_ms,
               figures.gl_errors.empty() ? "none" : figures.gl_errors, figures.grown_mb);
    std::fflush(stdout);
}

int run(const Options& options) {
    if (!options.pictures.empty()) std::filesystem::create_directories(options.pictures);
    fmt::print("{:<12}{:>10}{:>10}{:>10}{:>12}{:>12}\n", "scene", "median ms", "99 % ms", "CPU ms",
               "GL errors", "grown MB");
    bool has_errors = false;
    for (const std::string& scene : scene_names()) {
        if (!options.scene.empty() && scene != options.scene) continue;
        const SceneFigures figures = measure(scene, options);
        print(scene, figures);
        has_errors = has_errors || !figures.gl_errors.empty();
    }
    return has_errors ? 1 : 0;
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) try {
    touchstone::Options options;
    CLI::App app("Time of each scene a frame, GL errors, growth of memory");
    app.add_option("--frames", options.frames, "of each scene, at least")->check(CLI::Range(10, 1000000));
    app.add_option("--endure", options.endure_min, "minutes of each scene, at least");
    app.add_option("--pictures", options.pictures, "folder for pictures of what was shown");
    app.add_option("--scene", options.scene, "only this one");
    CLI11_PARSE(app, argc, argv);
    return touchstone::run(options);
} catch (const touchstone::Error& error) {
    fmt::print(stderr, "measure_scenes: {}\n", error.what());
    return static_cast<int>(error.status());
}
