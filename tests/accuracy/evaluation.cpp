#include "tests/accuracy/evaluation.hpp"

#include <cmath>
#include <fmt/core.h>
#include <future>

#include "tests/accuracy/baseline_run.hpp"
#include "tests/accuracy/scored_run.hpp"

namespace touchstone {
namespace {

std::vector<baselines::Method> all_methods() {
    std::vector<baselines::Method> methods = baselines::published_methods();
    for (baselines::Method& method : baselines::tuned_methods()) methods.push_back(std::move(method));
    return methods;
}

const char* hands_of(HandPlay play) {
    switch (play) {
        case HandPlay::touching:
            return "hands=2";
        case HandPlay::hovering:
            return "hands=2&gestures=hover";
        case HandPlay::hovering_low:
            return "hands=2&gestures=low";
        case HandPlay::none:
            break;
    }
    return "hands=0";
}

}  // namespace

std::string scene_of(const TableSequence& sequence) {
    return fmt::format("{}?{}&seed={}&frames={}&empty=4&height={}&tilt={}&sleeve=drawn&drift={:d}",
                       sequence.surface, hands_of(sequence.hands), sequence.seed, sequence.frames,
                       sequence.height_m, sequence.tilt_deg, sequence.drift);
}

double drawn_tilt_deg(int seed) {
    // Multiples of the golden ratio fall evenly between whole numbers.
    const double turns = 0.6180339887498949 * seed;
    return std::round(400.0 * (turns - std::floor(turns))) / 10.0;
}

void Evaluation::add(const TableSequence& sequence) {
    const std::string scene = scene_of(sequence);
    auto ours = std::async(std::launch::async, [&] { return logged_run(program_, "sim:" + scene); });
    std::vector<baselines::Method> methods = all_methods();
    const BaselineRun run = run_baselines(scene, methods);
    series_of(0, "Touchstone").append(run.truth, ours.get());
    for (std::size_t i = 0; i < methods.size(); ++i)
        series_of(i + 1, methods[i].name).append(run.truth, run.logs[i]);
}

void Evaluation::add(const Evaluation& other) {
    for (std::size_t i = 0; i < other.methods_.size(); ++i) {
        const auto& [method, series] = other.methods_[i];
        series_of(i, method).append(series.truth(), series.log());
    }
}

TouchSeries& Evaluation::series_of(std::size_t place, const std::string& method) {
    if (place == methods_.size()) methods_.push_back({method, {}});
    return methods_.at(place).series;
}

}  // namespace touchstone
