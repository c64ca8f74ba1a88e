#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "tests/accuracy/baselines/raster.hpp"

namespace touchstone::baselines {

struct PixelTouch {
    int id = 0;
    Eigen::Vector2d pixel_px = Eigen::Vector2d::Zero();
};

/// A published touch detector for depth pictures. The pictures come in order from the camera's start; the
/// first 101 at least show the scene without hands.
class Baseline {
  public:
    virtual ~Baseline() = default;
    /// The touches that are down in this frame.
    virtual std::vector<PixelTouch> process(const DepthPicture& picture) = 0;
};

struct Method {
    std::string name;
    std::unique_ptr<Baseline> baseline;
};

/// With the parameters they were published with, in the order of the table of baselines in the field notes.
std::vector<Method> published_methods();
/// Where those parameters are for a sensor with finer noise or fewer pixels than a Kinect v1: the same
/// method with what fits it.
std::vector<Method> tuned_methods();

}  // namespace touchstone::baselines
