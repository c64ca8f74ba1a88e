#pragma once

#include <filesystem>
#include <optional>

#include "ui/painting.hpp"

namespace touchstone {

/// A painting and the camera's pose in the scan it was painted on.
struct StoredPainting {
    Painting painting;
    RigidTransform T_g_c = RigidTransform::Identity();
};

/// The old file or the whole new one is there afterwards, after a power cut too. Throws Error{io_error}.
void save_painting(const std::filesystem::path& path, const Painting& painting, const RigidTransform& T_g_c);

/// None where there is no file yet. Throws Error{bad_data} that names the file when it is damaged, of another
/// kind or of another version.
std::optional<StoredPainting> load_painting(const std::filesystem::path& path);

}  // namespace touchstone
