#pragma once

#include <memory>

#include "platform/openni2_drivers/common/frame_source.hpp"
#include "platform/openni2_drivers/simulator/simulator_config.hpp"
#include "platform/openni2_drivers/simulator/triangle_mesh.hpp"

namespace touchstone {

/// The surfaces of the scene, in the frame of the poses that `poses=FILE` gives: what a reconstruction is
/// measured against, with MeshDistance. Throws Error{usage} for a table: it exists only as formulas
/// (sim::Scene).
sim::TriangleMesh truth_mesh(const SimulatorConfig& config);

/// A Kinect v1 before a scene of triangles: `room`, `wall` or `object`. Equal configurations give equal
/// frames; nothing depends on the clock.
class MeshSource : public FrameSource {
  public:
    /// Throws as truth_mesh does, and Error{io_error} when the poses cannot be written.
    explicit MeshSource(const SimulatorConfig& config);
    ~MeshSource() override;

    const SourceInfo& info() const override;
    void enable_color(bool enabled) override;
    bool next(SourceFrame& frame) override;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace touchstone
