#include "platform/openni2_drivers/sequence/sequence_source.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <utility>

#include "platform/image/jpeg_file.hpp"
#include "platform/image/png_file.hpp"
#include "platform/openni2_drivers/sequence/camera_intrinsics.hpp"
#include "platform/system/error.hpp"
#include "platform/system/log.hpp"

namespace touchstone {
namespace {

constexpr int largest_side_px = 4096;
constexpr std::uint16_t also_invalid = 65535;

Image8 as_rgb(Image8 image) {
    if (image.channels == 3) return image;
    const auto channels = static_cast<std::size_t>(image.channels);
    const std::size_t count = image.pixels.size() / channels;
    Image8 rgb{image.width_px, image.height_px, 3, std::vector<std::uint8_t>(3 * count)};
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t c = 0; c < 3; ++c)
            rgb.pixels[3 * i + c] = image.pixels[channels * i + (channels == 1 ? 0 : c)];
    }
    return rgb;
}

Image8 read_color_file(const std::filesystem::path& path) {
    const auto ending = path.extension();
    return ending == ".jpg" || ending == ".jpeg" ? read_jpeg_rgb(path) : as_rgb(read_png_8(path));
}

void check_size(const std::filesystem::path& path, int width_px, int height_px, int expected_width_px,
                int expected_height_px) {
    if (width_px == expected_width_px && height_px == expected_height_px) return;
    throw Error(ExitStatus::bad_data,
                fmt::format("{} is {}x{} while the pictures before it are {}x{}: a sequence keeps one size",
                            path.string(), width_px, height_px, expected_width_px, expected_height_px));
}

void check_limit(const std::filesystem::path& path, int width_px, int height_px) {
    if (width_px <= largest_side_px && height_px <= largest_side_px) return;
    throw Error(ExitStatus::bad_data, fmt::format("{} is {}x{}, the largest picture is {}x{}", path.string(),
                                                  width_px, height_px, largest_side_px, largest_side_px));
}

Intrinsics intrinsics_of(const SequenceFolder& folder, int width_px, int height_px) {
    if (!folder.intrinsics.empty()) return read_intrinsics(folder.intrinsics, width_px, height_px);
    const Intrinsics k = default_intrinsics(width_px, height_px);
    log_warning("no camera-intrinsics.txt in {}: taking the Kinect's nominal {:.1f} {:.1f} {:.1f} {:.1f}",
                folder.entries.front().depth.parent_path().string(), k.fx_px, k.fy_px, k.cx_px, k.cy_px);
    return k;
}

}  // namespace

SequenceSource::SequenceSource(const std::filesystem::path& folder) : folder_(list_sequence(folder)) {
    const SequenceEntry& first = folder_.entries.front();
    const Image16 depth = read_png_16(first.depth);
    check_limit(first.depth, depth.width_px, depth.height_px);
    info_.intrinsics = intrinsics_of(folder_, depth.width_px, depth.height_px);
    info_.default_pace = Pace::step;
    const auto with_color = std::find_if(folder_.entries.begin(), folder_.entries.end(),
                                         [](const SequenceEntry& entry) { return !entry.color.empty(); });
    if (with_color == folder_.entries.end()) return;
    const Image8 color = read_color_file(with_color->color);
    check_limit(with_color->color, color.width_px, color.height_px);
    info_.has_color = true;
    info_.color_width_px = color.width_px;
    info_.color_height_px = color.height_px;
}

bool SequenceSource::next(SourceFrame& frame) {
    if (next_entry_ >= folder_.entries.size()) return false;
    const SequenceEntry& entry = folder_.entries[next_entry_++];
    frame.index = entry.index;
    frame.timestamp_us = entry.timestamp_us;
    read_depth(entry, frame);
    read_color(entry, frame);
    return true;
}

void SequenceSource::read_depth(const SequenceEntry& entry, SourceFrame& frame) const {
    Image16 image = read_png_16(entry.depth);
    check_size(entry.depth, image.width_px, image.height_px, info_.intrinsics.width_px,
               info_.intrinsics.height_px);
    const int units = folder_.units_per_mm;
    for (std::uint16_t& value : image.pixels) {
        value = value == also_invalid ? std::uint16_t{0}
                                      : static_cast<std::uint16_t>((value + units / 2) / units);
    }
    frame.depth_mm = std::move(image.pixels);
}

void SequenceSource::read_color(const SequenceEntry& entry, SourceFrame& frame) const {
    frame.color_rgb.clear();
    if (!color_enabled_ || entry.color.empty()) return;
    Image8 image = read_color_file(entry.color);
    check_size(entry.color, image.width_px, image.height_px, info_.color_width_px, info_.color_height_px);
    frame.color_rgb = std::move(image.pixels);
}

std::unique_ptr<FrameSource> open_sequence(std::string_view after_scheme) {
    return std::make_unique<SequenceSource>(std::filesystem::path(after_scheme));
}

}  // namespace touchstone
