#pragma once

#include <string>

#include "tests/accuracy/touch_score.hpp"

namespace touchstone {

/// What the program reports of every frame of a sensor, headless. Throws std::runtime_error where it fails.
TouchLog logged_run(const std::string& program, const std::string& sensor);

/// Runs the program headless, every frame, on a simulated table and scores its touches: `scene` flat, curved,
/// cluttered, bowl or mixed; two hands, Kinect noise and drift. Throws std::runtime_error where the program
/// fails.
TouchScore scored_run(const std::string& program, const std::string& scene, int seed, int frames);

}  // namespace touchstone
