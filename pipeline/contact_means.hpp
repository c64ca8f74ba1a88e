#pragma once

#include <span>
#include <vector>

#include "pipeline/touch_bias.hpp"
#include "pipeline/touch_event.hpp"

namespace touchstone {

/// A finger's contact that is over.
struct EndedContact {
    TouchPlace mean;      ///< over its frames
    float drag_m = 0.0f;  ///< the farthest it was from where it began
};

/// What fingers touched, told when they lift.
class ContactMeans {
  public:
    /// The touches of a frame; gives the contacts that ended in it, in order.
    std::vector<EndedContact> take(std::span<const TouchEvent> touches);

  private:
    struct Contact {
        int id = 0;
        int frames = 0;
        TouchPlace sum;  ///< over the frames
        Eigen::Vector3f first_c_m{0.f, 0.f, 0.f};
        float drag_m = 0.f;
    };

    void follow(const Fingertip& tip);

    std::vector<Contact> contacts_;
};

}  // namespace touchstone
