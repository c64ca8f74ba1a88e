#pragma once

#include <cstdint>
#include <vector>

#include "platform/openni2_drivers/simulator/projector.hpp"
#include "platform/system/projected_picture.hpp"

namespace touchstone::sim {

/// What a projector's picture does to the colours that a camera sees. Light and grey levels are
/// proportional; what the room's light shows of a surface's colour is what the projector's light shows, too.
class ProjectorLight {
  public:
    /// `ambient`: how bright the room is, 0..1 of the projector's white.
    ProjectorLight(const Projector& projector, float ambient, std::uint64_t seed)
        : projector_(projector), ambient_(ambient), seed_(seed) {}

    /// Takes colours in full room light to those in the room's and the projector's, with the camera's noise.
    /// `depth_m`: z of what is seen at each pixel, infinite where there is nothing. `picture`: null where
    /// nothing is thrown; of another size than the projector's it is stretched.
    void shine(std::vector<std::uint8_t>& color_rgb, const std::vector<float>& depth_m, const TableView& view,
               const ProjectedPicture* picture, int frame);

  private:
    struct LitPlace {
        float x_px = 0.0F, y_px = 0.0F, depth_m = 0.0F;  // depth 0: not in the picture
    };

    void find_places(const std::vector<float>& depth_m, const TableView& view);
    void find_shadows();
    bool is_in_shadow(const LitPlace& place) const;
    Vec3 thrown_light(const LitPlace& place, const ProjectedPicture& picture) const;

    Projector projector_;
    float ambient_;
    std::uint64_t seed_;
    std::vector<LitPlace> places_;  // one for each pixel of the camera
    std::vector<float> nearest_m_;  // what the projector lights first, in cells of its picture
};

}  // namespace touchstone::sim
