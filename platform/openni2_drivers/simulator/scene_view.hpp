#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "platform/openni2_drivers/simulator/hand_layer.hpp"
#include "platform/openni2_drivers/simulator/simulator_config.hpp"

namespace touchstone::sim {

/// What the camera sees of a scene of triangles, frame by frame.
class SceneView {
  public:
    virtual ~SceneView() = default;
    /// Fills the picture, infinite depth where nothing is seen. Gives the camera's pose in the frame of
    /// truth_mesh.
    virtual Eigen::Isometry3d draw(int frame, Picture& picture) = 0;
    /// Colours of the frame drawn last, 3 bytes a pixel.
    virtual void color(const Picture& picture, std::vector<std::uint8_t>& color_rgb) = 0;
};

/// `room` and `wall`: the camera moves.
std::unique_ptr<SceneView> make_moving_view(const SimulatorConfig& config);

/// `object`: it is turned, by hands or by itself, before the camera; a wall stands 1.8 m away.
std::unique_ptr<SceneView> make_object_view(const SimulatorConfig& config);

}  // namespace touchstone::sim
