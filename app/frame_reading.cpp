#include "app/frame_reading.hpp"

#include <chrono>

#include "platform/system/error.hpp"

namespace touchstone {

namespace {

constexpr int read_timeout_ms = 100;
constexpr std::chrono::seconds patience{10};

}  // namespace

std::optional<DepthFrame> read_frame(DepthCamera& camera, TerminationSignals& signals) {
    const auto start = std::chrono::steady_clock::now();
    while (!signals.arrived()) {
        ReadResult result = camera.read(read_timeout_ms);
        if (auto* frame = std::get_if<DepthFrame>(&result)) return std::move(*frame);
        if (std::holds_alternative<StreamEnd>(result)) return std::nullopt;
        if (const auto* lost = std::get_if<CameraLost>(&result))
            throw Error(ExitStatus::unavailable, lost->reason);
        if (std::chrono::steady_clock::now() - start > patience)
            throw Error(ExitStatus::unavailable,
                        camera.name() + " gives no pictures: unplug it and plug it in again");
    }
    return std::nullopt;
}

}  // namespace touchstone
