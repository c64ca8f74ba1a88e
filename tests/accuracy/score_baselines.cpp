// score_baselines PROGRAM: touchstone and seven published methods on the same simulated tables, scored alike;
// tables in Markdown, and a bar chart where it is asked for. Seeds up to 50 are for tuning, from 101 for
// scores.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>
#include <optional>

#include "tests/accuracy/evaluation_chart.hpp"
#include "tests/accuracy/evaluation_table.hpp"
#include "tests/accuracy/touch_score.hpp"
#include "tests/support/program_main.hpp"

namespace touchstone {
namespace {

struct Options {
    std::string program;
    std::vector<std::string> surfaces{"flat", "curved", "bowl", "cluttered"};
    std::vector<double> heights_m{0.7, 0.9, 1.1, 1.4};
    int frames = 900, first_seed = 101, seeds = 1;
    double ghost_height_m = 1.0;
    std::optional<double> tilt_deg;
    bool steady = false;
    std::string plot;
};

void print(const std::string& text) {
    std::fputs(text.c_str(), stdout);
    std::fflush(stdout);
}

/// All seeds of one kind of sequence.
Evaluation run_seeds(const Options& options, const std::string& surface, double height_m, HandPlay hands) {
    Evaluation evaluation(options.program);
    for (int seed = options.first_seed; seed < options.first_seed + options.seeds; ++seed) {
        const double tilt_deg = options.tilt_deg.value_or(drawn_tilt_deg(seed));
        const TableSequence sequence{surface,  seed,  options.frames, height_m,
                                     tilt_deg, hands, !options.steady};
        std::fprintf(stderr, "sim:%s\n", scene_of(sequence).c_str());
        evaluation.add(sequence);
    }
    return evaluation;
}

std::string place_text(const Options& options, int frame, const std::array<double, 3>& camera_mm) {
    return fmt::format("seed {} frame {} at ({:.0f}, {:.0f}, {:.0f}) mm",
                       options.first_seed + frame / options.frames, frame % options.frames, camera_mm[0],
                       camera_mm[1], camera_mm[2]);
}

/// To standard error: where our own detector is wrong.
void print_mistakes(const Options& options, const std::string& what, const MethodSeries& ours) {
    const TouchScore score = score_touches(ours.series.truth(), ours.series.log());
    for (const MissedContact& missed : score.missed)
        fmt::print(stderr, "{}: {} not found, hand {} finger {}, {} frames\n", what,
                   place_text(options, missed.first_frame, missed.camera_mm), missed.hand, missed.finger,
                   missed.last_frame - missed.first_frame + 1);
    for (const SpuriousTouch& touch : score.spurious)
        fmt::print(stderr, "{}: {} spurious, id {}\n", what,
                   place_text(options, touch.first_frame, touch.camera_mm), touch.id);
}

Evaluation run_contacts(const Options& options) {
    Evaluation all(options.program);
    print(contact_head());
    for (const std::string& surface : options.surfaces)
        for (const double height_m : options.heights_m) {
            const Evaluation cell = run_seeds(options, surface, height_m, HandPlay::touching);
            const std::string what = fmt::format("{} {:.1f}", surface, height_m);
            for (const MethodSeries& method : cell.methods()) print(contact_row(what, method));
            print_mistakes(options, what, cell.methods().front());
            all.add(cell);
        }
    for (const MethodSeries& method : all.methods()) print(contact_row("all", method));
    return all;
}

using Row = std::string (*)(const std::string&, const MethodSeries&);

/// Sequences in which nothing touches, one row for each surface and method.
Evaluation run_ghosts(const Options& options, HandPlay hands, const std::string& name, Row row) {
    Evaluation all(options.program);
    for (const std::string& surface : options.surfaces) {
        const Evaluation cell = run_seeds(options, surface, options.ghost_height_m, hands);
        for (const MethodSeries& method : cell.methods())
            print(row(fmt::format("{}, {} {:.1f}", name, surface, options.ghost_height_m), method));
        print_mistakes(options, fmt::format("{}, {}", name, surface), cell.methods().front());
        all.add(cell);
    }
    for (const MethodSeries& method : all.methods()) print(row(name + ", all", method));
    return all;
}

Options read_options(CLI::App& app, Options& options) {
    app.add_option("PROGRAM", options.program, "touchstone")->required()->check(CLI::ExistingFile);
    app.add_option("--surfaces", options.surfaces, "flat, curved, bowl, cluttered")->delimiter(',');
    app.add_option("--heights", options.heights_m, "of the camera, metres")->delimiter(',');
    app.add_option("--frames", options.frames, "of each sequence, 30 a second, the first 120 without hands");
    app.add_option("--seed", options.first_seed, "first seed: up to 50 for tuning, from 101 for scores");
    app.add_option("--seeds", options.seeds, "number of seeds");
    app.add_option("--tilt", options.tilt_deg, "of the camera, degrees; else 0 to 40, drawn from the seed");
    app.add_option("--ghost-height", options.ghost_height_m, "of the camera where nothing touches, metres");
    app.add_flag("--steady", options.steady,
                 "a sensor whose columns do not drift, as backgrounds that are learnt once need");
    app.add_option("--plot", options.plot, "bar chart, PNG; needs gnuplot");
    return options;
}

std::string measured(const Options& options) {
    const auto joined = [](const auto& values) { return fmt::format("{}", fmt::join(values, ", ")); };
    return fmt::format(
        "Simulated Kinect v1{}; {}; camera {} m high, tilt {}; seeds {} to {}, {} frames each at 30 Hz",
        options.steady ? " without drift" : "", joined(options.surfaces), joined(options.heights_m),
        options.tilt_deg ? fmt::format("{} degrees", *options.tilt_deg) : "0 to 40 degrees by seed",
        options.first_seed, options.first_seed + options.seeds - 1, options.frames);
}

int run(int argc, char** argv) {
    CLI::App app("Touchstone and seven published methods on the same simulated tables.");
    Options options;
    read_options(app, options);
    CLI11_PARSE(app, argc, argv);
    print(measured(options) + "\n\n");
    const Evaluation contacts = run_contacts(options);
    print("\n" + ghost_head());
    run_ghosts(options, HandPlay::none, "empty table", ghost_row);
    const Evaluation hovering =
        run_ghosts(options, HandPlay::hovering, "hands hover 15 to 200 mm", ghost_row);
    print("\n" + hover_head());
    run_ghosts(options, HandPlay::hovering_low, "hands hover 2 to 20 mm", hover_row);
    if (!options.plot.empty())
        draw_bar_chart(evaluation_chart(contacts.methods(), hovering.methods(), measured(options)),
                       options.plot);
    return 0;
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) {
    return touchstone::test::run_main("score_baselines", touchstone::run, argc, argv);
}
