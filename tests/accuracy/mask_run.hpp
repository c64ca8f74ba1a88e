#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/accuracy/mask_score.hpp"

namespace touchstone {

/// One frame against its truth. Sizes in pixels with a depth reading.
struct MaskFrame {
    std::string name;
    long truth = 0, marked = 0, both = 0, readings = 0;
    double iou() const;           ///< 1 where neither has a pixel
    double marked_share() const;  ///< of the pixels with a reading
};

/// Where pictures of the worst frames go: nowhere when empty.
using PictureFolder = std::filesystem::path;

/// The program, headless, every frame, on a simulated table with two hands, Kinect noise and drift. `scene`
/// flat, curved or cluttered. Throws std::runtime_error where the program fails.
MaskScore scored_simulation(const std::string& program, const std::string& scene, int seed, int frames,
                            const PictureFolder& pictures = {});

/// The labelled table: its background 25 times, then each scene once. Counts the pixels that have a reading,
/// a background and a label; labels from 20 on are objects.
std::vector<MaskFrame> scored_table(const std::string& program, const std::filesystem::path& table,
                                    const PictureFolder& pictures = {});

/// The real room, before and after a person was there. Frames 0 to 19 are played as the scan and once more
/// while live, then 20 to 345.
struct RoomScore {
    std::vector<MaskFrame> before;  ///< 0 to 19
    std::vector<MaskFrame> after;   ///< 330 to 345
    double least_person = 1.0;      ///< smallest share marked of frames 80, 150, 220, 280
};
RoomScore scored_room(const std::string& program, const std::filesystem::path& room,
                      const PictureFolder& pictures = {});

}  // namespace touchstone
