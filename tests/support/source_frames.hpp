#pragma once

#include <string>
#include <variant>
#include <vector>

#include "platform/camera/depth_camera.hpp"

namespace touchstone::test {

/// All frames of a sensor URI, in order, up to its end.
inline std::vector<DepthFrame> frames_of(const std::string& uri, bool with_color = false) {
    DepthCamera camera = DepthCamera::open(uri, Pace::step, with_color);
    std::vector<DepthFrame> frames;
    for (;;) {
        ReadResult result = camera.read(10'000);
        auto* frame = std::get_if<DepthFrame>(&result);
        if (frame == nullptr) return frames;
        frames.push_back(std::move(*frame));
    }
}

}  // namespace touchstone::test
