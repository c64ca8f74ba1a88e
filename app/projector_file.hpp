#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "pipeline/projector_fit.hpp"

namespace touchstone {

/// A calibrated projector as it is kept. Its model takes points of the depth camera's frame, as the camera
/// stood then: a scan's frame is another one after each scan.
struct SavedProjector {
    ProjectorModel model;
    std::string method;  ///< touch or graycode
    float rms_px = 0.0f, rms_mm = 0.0f;
    int points = 0;
    /// When it was written, seconds of the system's clock since 1970; 0: by a program that did not say.
    std::int64_t written_s = 0;
};

/// Versioned, checksummed, atomic. Throws Error{io_error}.
void save_projector(const std::filesystem::path& path, const SavedProjector& projector);

/// Throws Error{no_input} where there is no file, Error{bad_data} where it is damaged or says what cannot be.
SavedProjector load_projector(const std::filesystem::path& path);

/// For people: the day on which it was written.
std::string day_of(const SavedProjector& projector);

}  // namespace touchstone
