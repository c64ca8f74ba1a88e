#include <cmath>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <numeric>

#include "platform/system/percentile.hpp"
#include "tests/accuracy/touch_score.hpp"

namespace touchstone {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double value) { return std::round(value * 1000.0) / 1000.0; }

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Null where there is nothing to say it of.
Json percentile_json(const std::vector<double>& values, double percent, double scale = 1.0) {
    return values.empty() ? Json() : Json(rounded(scale * percentile(values, percent)));
}

Json share(int part, int rest) { return rounded(part / std::max(1.0, static_cast<double>(part + rest))); }

Json found_json(const Found& found) {
    return {{"contacts", found.contacts}, {"found", found.found}, {"rate", rounded(found.rate())}};
}

Json optional_json(const std::optional<double>& value) { return value ? Json(rounded(*value)) : Json(); }

Json hover_json(const HoverScore& hover) {
    return {{"tips", hover.tips},
            {"mistaken", hover.mistaken},
            {"smallest_mistaken_mm", optional_json(hover.smallest_mistaken_mm)},
            {"largest_mistaken_mm", optional_json(hover.largest_mistaken_mm)},
            {"told_from_mm", optional_json(hover.told_from_mm)}};
}

void add_contacts(Json& json, const TouchScore& score) {
    json["contacts"] = score.all.contacts;
    json["detected"] = score.all.found;
    json["detection_rate"] = rounded(score.all.rate());
    json["of_one_frame"] = found_json(score.of_one_frame);
    json["of_two_frames"] = found_json(score.of_two_frames);
    json["of_three_and_more_frames"] = found_json(score.of_three_and_more);
    json["of_two_and_more_frames"] = found_json(score.of_two_and_more);
    json["second_fingers"] = score.second_fingers.contacts;
    json["second_fingers_detected"] = score.second_fingers.found;
}

void add_spurious(Json& json, const TouchScore& score) {
    const double per_minute = score.frames == 0 ? 0.0 : score.spurious_ids / score.minutes();
    json["spurious"] = score.spurious_ids;
    json["spurious_per_min"] = rounded(per_minute);
    json["spurious_per_hour"] = rounded(per_minute * 60.0);
    json["frame_precision"] = share(score.true_frames, score.false_frames);
    json["frame_recall"] = share(score.true_frames, score.missed_frames);
}

void add_quality(Json& json, const TouchScore& score) {
    const double frame_ms = 1000.0 / score.fps;
    json["position_mm_mean"] = score.position_mm.empty() ? Json() : Json(rounded(mean(score.position_mm)));
    json["position_mm_median"] = percentile_json(score.position_mm, 50.0);
    json["position_mm_p95"] = percentile_json(score.position_mm, 95.0);
    json["latency_frames_median"] = percentile_json(score.late_frames, 50.0);
    json["latency_frames_p95"] = percentile_json(score.late_frames, 95.0);
    json["latency_ms_median"] = percentile_json(score.late_frames, 50.0, frame_ms);
    json["latency_ms_p95"] = percentile_json(score.late_frames, 95.0, frame_ms);
    json["id_switches"] = score.id_switches;
}

std::string number(const Json& value, int digits) {
    return value.is_null() ? "-" : fmt::format("{:.{}f}", value.get<double>(), digits);
}

}  // namespace

std::string json_of(const TouchScore& score) {
    Json json;
    add_contacts(json, score);
    add_spurious(json, score);
    add_quality(json, score);
    json["hover"] = hover_json(score.hover);
    json["frames"] = score.frames;
    return json.dump(1);
}

std::string line_of(const TouchScore& score) {
    const Json json = Json::parse(json_of(score));
    return fmt::format(
        "found {}/{} ({:.2f} %), of 2+ frames {}/{} ({:.2f} %), 1 frame {}/{} | spurious {} ({:.1f} /min) | "
        "position {} mm, p95 {} | late {} frames, p95 {} | hover told from {} mm, mistaken {}/{} | id "
        "switches {}",
        score.all.found, score.all.contacts, 100.0 * score.all.rate(), score.of_two_and_more.found,
        score.of_two_and_more.contacts, 100.0 * score.of_two_and_more.rate(), score.of_one_frame.found,
        score.of_one_frame.contacts, score.spurious_ids, json["spurious_per_min"].get<double>(),
        number(json["position_mm_mean"], 2), number(json["position_mm_p95"], 2),
        number(json["latency_frames_median"], 1), number(json["latency_frames_p95"], 1),
        number(json["hover"]["told_from_mm"], 0), score.hover.mistaken, score.hover.tips, score.id_switches);
}

}  // namespace touchstone
