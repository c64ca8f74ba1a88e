#include "tests/accuracy/mask_score.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <numeric>

#include "platform/image/png_file.hpp"
#include "platform/system/error.hpp"
#include "platform/system/percentile.hpp"

namespace touchstone {
namespace {

using Json = nlohmann::ordered_json;

constexpr int first_frame = 60;
constexpr long fewest_foreground_pixels = 1500;
constexpr int frames_of_entry = 3;

Json rounded(double value) { return std::round(value * 10'000.0) / 10'000.0; }

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Numbers of the frames that have a truth, in order.
std::vector<int> frames_in(const std::filesystem::path& folder) {
    std::vector<int> frames;
    std::error_code failure;
    for (const auto& entry : std::filesystem::directory_iterator(folder, failure)) {
        const std::string name = entry.path().filename().string();
        int frame = 0;
        if (name.ends_with(".mask.png") && std::sscanf(name.c_str(), "truth-%6d", &frame) == 1)
            frames.push_back(frame);
    }
    if (frames.empty()) {
        throw Error(ExitStatus::no_input, fmt::format("{} holds no truth-%06d.mask.png", folder.string()));
    }
    std::sort(frames.begin(), frames.end());
    return frames;
}

void check_size(std::size_t pixels, std::size_t expected, const std::filesystem::path& path) {
    if (pixels == expected) return;
    throw Error(ExitStatus::bad_data, fmt::format("{} is not of the size of its truth", path.string()));
}

void score_frame(MaskScorer& scorer, int frame, const std::filesystem::path& truth_folder,
                 const std::filesystem::path& maps_folder) {
    const Image8 truth = read_png_8(truth_folder / fmt::format("truth-{:06}.mask.png", frame));
    const auto depth_path = truth_folder / fmt::format("frame-{:06}.depth.png", frame);
    const Image16 depth = read_png_16(depth_path);
    check_size(depth.pixels.size(), truth.pixels.size(), depth_path);
    const auto mask_path = maps_folder / fmt::format("frame-{:06}.foreground.png", frame);
    if (!std::filesystem::exists(mask_path)) return scorer.take_missing(truth.pixels, depth.pixels);
    const Image8 mask = read_png_8(mask_path);
    check_size(mask.pixels.size(), truth.pixels.size(), mask_path);
    scorer.take_frame(truth.pixels, mask.pixels, depth.pixels);
}

}  // namespace

void MaskScorer::take_frame(std::span<const std::uint8_t> truth, std::span<const std::uint8_t> mask,
                            std::span<const std::uint16_t> depth_mm) {
    long foreground = 0, readings = 0, both = 0, either = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const bool is_foreground = truth[i] != 0, is_marked = mask[i] != 0;
        foreground += is_foreground;
        if (depth_mm[i] == 0) continue;
        ++readings;
        both += is_foreground && is_marked;
        either += is_foreground || is_marked;
    }
    frames_with_foreground_ = foreground > fewest_foreground_pixels ? frames_with_foreground_ + 1 : 0;
    const auto share = [](long part, long whole) {
        return static_cast<double>(part) / static_cast<double>(std::max(1L, whole));
    };
    if (foreground == 0) {
        score_.false_area.push_back(share(either, readings));
    } else if (frames_with_foreground_ > frames_of_entry) {
        score_.overlap.push_back(share(both, either));
    }
}

void MaskScorer::take_missing(std::span<const std::uint8_t> truth, std::span<const std::uint16_t> depth_mm) {
    ++score_.missing;
    take_frame(truth, std::vector<std::uint8_t>(truth.size()), depth_mm);
}

MaskScore score_masks(const std::filesystem::path& truth_folder, const std::filesystem::path& maps_folder) {
    MaskScorer scorer;
    for (const int frame : frames_in(truth_folder)) {
        if (frame >= first_frame) score_frame(scorer, frame, truth_folder, maps_folder);
    }
    return scorer.result();
}

std::string json_of(const MaskScore& score) {
    Json json;
    const bool has_overlap = !score.overlap.empty();
    json["frames"] = score.overlap.size();
    json["iou_median"] = has_overlap ? rounded(percentile(score.overlap, 50.0)) : Json();
    json["iou_p10"] = has_overlap ? rounded(percentile(score.overlap, 10.0)) : Json();
    json["false_area"] = score.false_area.empty() ? Json() : rounded(mean(score.false_area));
    json["empty_frames"] = score.false_area.size();
    json["missing"] = score.missing;
    return json.dump(1);
}

std::string line_of(const MaskScore& score) {
    const double false_percent = score.false_area.empty() ? 0.0 : 100.0 * mean(score.false_area);
    return fmt::format(
        "IoU median {:.3f}, 10th percentile {:.3f} over {} frames | false area {:.3f} % over {} frames | "
        "{} masks missing",
        percentile(score.overlap, 50.0), percentile(score.overlap, 10.0), score.overlap.size(), false_percent,
        score.false_area.size(), score.missing);
}

}  // namespace touchstone
