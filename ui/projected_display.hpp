#pragma once

#include <memory>

#include "pipeline/projector_model.hpp"
#include "platform/display/display.hpp"
#include "ui/view_from_above.hpp"

namespace touchstone {

struct ProjectedDisplayConfig {
    bool spare_hands = true;  ///< no light on what the depth camera sees in front of the surface
};

/// A display on the surface: what is drawn is the view from above, and a projector throws it so that it lands
/// there. Until it knows how, the projector shows the picture as it is, as large as fits.
class ProjectedDisplay : public Display {
  public:
    /// `projector` outlives this. Throws Error{unavailable} when shaders or pictures fail.
    explicit ProjectedDisplay(Display& projector, const ProjectedDisplayConfig& config = {});
    ~ProjectedDisplay() override;

    /// How to throw the next frames; the size of the display becomes the view's. `surface` may be null: then
    /// the view's area is lit as if it were flat. Call it between frames, whenever one of them is another.
    void set_mapping(const ProjectorModel& model, const ViewFromAbove& view, const SurfaceGrid* surface);
    /// Where hands are, of each new frame as the depth camera told it.
    void see_hands(const TableFrame& told);

    /// Of the view from above; of the projector until there is a mapping.
    PixelSize size_px() const override;
    void begin_frame() override;
    void present() override;
    /// What the projector throws.
    Picture read_pixels() override;
    bool should_close() override;
    std::optional<char> take_key() override { return projector_.take_key(); }
    bool is_lost() const override { return projector_.is_lost(); }

  private:
    struct Parts;

    Display& projector_;
    ProjectedDisplayConfig config_;
    std::unique_ptr<Parts> parts_;
};

}  // namespace touchstone
