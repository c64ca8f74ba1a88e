#pragma once

#include <memory>
#include <string>

#include "app/config.hpp"
#include "app/projector_file.hpp"
#include "pipeline/background_model.hpp"
#include "pipeline/interaction_pipeline.hpp"
#include "pipeline/projector_model.hpp"
#include "pipeline/surface_grid.hpp"

namespace touchstone {

/// Where a projector's picture lies on the table that runs: its model in the scan's frame, and the surface
/// that it lights. A knock moves both where they hang on one mount; else the projector stays where it was in
/// the room.
class ProjectorMapping {
  public:
    ProjectorMapping(const SavedProjector& projector, bool moves_with_camera)
        : from_camera_(projector.model), moves_with_camera_(moves_with_camera) {}

    /// After each frame.
    void follow(InteractionState state, const BackgroundModel* background, const Intrinsics& intrinsics);
    /// Null until the table is live.
    const std::shared_ptr<const ProjectorModel>& model() const { return model_; }
    const std::shared_ptr<const SurfaceGrid>& surface() const { return surface_; }
    /// For the operator: empty when all is well.
    const std::string& note() const { return note_; }
    /// How often something has happened after which nobody knows whether it still holds: the start is the
    /// first, a knock or a new scan of a camera that the projector does not hang on are others.
    int doubts() const { return doubts_; }
    /// A check has answered them: what the operator is told from now on, empty for all is well.
    void answer(const std::string& note) { note_ = note; }

  private:
    void place(const RigidTransform& T_g_c);
    void refresh_surface(const BackgroundModel& background, const Intrinsics& intrinsics);

    ProjectorModel from_camera_;  // of points of the camera's frame
    bool moves_with_camera_;
    bool is_new_scan_ = true;
    int frames_ = 0, versions_ = 0, doubts_ = 0;
    RigidTransform T_g_c_ = RigidTransform::Identity();
    std::shared_ptr<const ProjectorModel> model_;
    std::shared_ptr<const SurfaceGrid> surface_;
    std::string note_;
};

/// The background as the camera sees it, every `step_px`-th pixel. Waits for the device.
SurfaceGrid make_surface_grid(const SurfacePrediction& prediction, const Intrinsics& intrinsics,
                              const RigidTransform& T_g_c, int step_px);

}  // namespace touchstone
