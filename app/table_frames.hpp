#pragma once

#include "pipeline/interaction_pipeline.hpp"
#include "platform/camera/depth_camera.hpp"
#include "ui/table_frame.hpp"

namespace touchstone {

/// What the screen is told of a frame that the pipeline has seen; renders the view of it, or, with
/// `shows_camera`, takes the frame's colours where it has some. Of rates, times and what scenes wish for
/// nothing.
TableFrame make_table_frame(InteractionPipeline& pipeline, const InteractionFrame& result,
                            const DepthFrame& frame, int scan_frames_wanted, bool shows_camera);

}  // namespace touchstone
