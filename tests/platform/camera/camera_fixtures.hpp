#pragma once

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <string>
#include <variant>
#include <vector>

#include "platform/camera/depth_camera.hpp"
#include "platform/image/png_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {

constexpr int patient_ms = 10'000;

/// A depth picture that is different for each index and in each pixel.
inline Image16 numbered_picture(int index, int width_px = 32, int height_px = 24) {
    Image16 image{width_px, height_px, {}};
    for (int i = 0; i < width_px * height_px; ++i) {
        image.pixels.push_back(
            static_cast<std::uint16_t>(i % 11 == 0 ? 0 : 400 + (index * 131 + i * 7) % 9000));
    }
    return image;
}

inline Image8 numbered_color(int index, int width_px = 32, int height_px = 24) {
    return {width_px, height_px, 3,
            std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width_px * height_px),
                                      static_cast<std::uint8_t>(index))};
}

inline std::string depth_name(int index) { return fmt::format("frame-{:06d}.depth.png", index); }
inline std::string color_name(int index) { return fmt::format("frame-{:06d}.color.png", index); }

inline void write_sequence(const TemporaryFolder& folder, int frames, bool with_color = false) {
    for (int index = 0; index < frames; ++index) {
        write_png(folder / depth_name(index), numbered_picture(index));
        if (with_color) write_png(folder / color_name(index), numbered_color(index));
    }
}

inline std::string sequence_uri(const TemporaryFolder& folder) { return "seq:" + folder.path().string(); }

inline std::string shared_data(const std::string& name) {
    return std::string(TOUCHSTONE_SHARED_DIR) + "/data/" + name;
}

/// All frames up to the end; a test failure where it ends in another way.
inline std::vector<DepthFrame> read_to_end(DepthCamera& camera) {
    std::vector<DepthFrame> frames;
    for (;;) {
        ReadResult result = camera.read(patient_ms);
        if (auto* frame = std::get_if<DepthFrame>(&result)) {
            frames.push_back(std::move(*frame));
            continue;
        }
        EXPECT_TRUE(std::holds_alternative<StreamEnd>(result)) << "ended with result " << result.index();
        return frames;
    }
}

}  // namespace touchstone
