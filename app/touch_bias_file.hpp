#pragma once

#include <filesystem>

#include "pipeline/touch_bias.hpp"

namespace touchstone {

/// Keeps what the step with the crosses told: JSON with along_mm, across_mm, sigma_mm and rms_mm, written
/// atomically. Throws Error{io_error}.
void save_touch_bias(const std::filesystem::path& path, const TouchBiasFit& fit);

/// Throws Error: no_input where there is no such file, bad_data where it is none of ours, or says more than
/// 20 mm.
TouchBias load_touch_bias(const std::filesystem::path& path);

}  // namespace touchstone
