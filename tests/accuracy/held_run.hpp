#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/held_object.hpp"

namespace touchstone {

/// An object is scanned while it floats, then turned by two hands before the camera at a distance.
struct HeldRun {
    std::filesystem::path mesh;
    int seed = 1;
    double distance_m = 1.0;
    int frames = 643;
    int scan_frames = 643;
    int away_every = 160;  ///< frames after which the object is out of view ...
    int away_frames = 20;  ///< ... for so many
};

struct HeldScore {
    int frames = 0;   ///< with the object in view
    int tracked = 0;  ///< of those
    int unseen = 0;   ///< frames tracked without an object: must be 0
    int lost = 0, found = 0;
    int astray = 0;  ///< frames that say tracked and are more than 30 mm or 15 degrees off
    double rms_mm = 0.0, rms_deg = 0.0;  ///< of all frames tracked, the ones astray too
    double largest_mm = 0.0, largest_deg = 0.0;
    int longest_search = 0;  ///< frames from the object's appearance to its pose
    double slowest_ms = 0.0, median_ms = 0.0;
    double model_mm = 0.0;             ///< mean error of the scan
    std::vector<std::string> reasons;  ///< of the losses
};

/// The model of the object: its scan, and where it is in the mesh's frame.
struct ScannedObject {
    VolumeSnapshot volume;
    RigidTransform T_m_o = RigidTransform::Identity();  ///< volume to mesh
    double error_mm = 0.0;
};

ScannedObject scan_object(const Device& device, const HeldRun& run);
HeldScore run_held(const Device& device, const HeldRun& run, const ScannedObject& object);

}  // namespace touchstone
