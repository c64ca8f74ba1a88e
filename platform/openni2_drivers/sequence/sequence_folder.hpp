#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace touchstone {

/// One frame of a sequence folder; nothing of it is read yet.
struct SequenceEntry {
    int index = 0;                   ///< the file's number; TUM: counted from 0
    std::uint64_t timestamp_us = 0;  ///< TUM's, else index / 30 s
    std::filesystem::path depth;
    std::filesystem::path color;  ///< empty where the frame has none
    std::filesystem::path pose;   ///< empty where the frame has none
};

struct SequenceFolder {
    std::vector<SequenceEntry> entries;  ///< ascending index, at least one
    int units_per_mm = 1;  ///< of the values in the depth pictures: TUM stores fifths of a millimetre
    std::filesystem::path intrinsics;  ///< empty where the folder has none
};

/// Lists a folder of either layout: `frame-%06d.depth.png` with `frame-%06d.color.{png,jpg}`,
/// `frame-%06d.pose.txt`; or TUM RGB-D's depth.txt and rgb.txt, the nearest colour picture within 20 ms of
/// each depth picture. Throws Error: no_input (no such folder, no frames in it), bad_data (a list that cannot
/// be read).
SequenceFolder list_sequence(const std::filesystem::path& folder);

}  // namespace touchstone
