#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/maps.hpp"
#include "platform/opencl/program.hpp"

namespace touchstone {

struct ConnectedComponentsConfig {
    SensorNoise noise{0.0012f, 0.0019f, 0.4f, 0.0001f};  ///< Kinect v1, Nguyen et al. 2012
    float gap_sigmas = 6.0f;  ///< neighbours farther apart in depth than both of these are not connected
    float gap_per_m = 0.015f;
};

/// Columns and rows of a part of a picture; the last ones are part of it.
struct PixelBox {
    int min_x_px = 0, min_y_px = 0, max_x_px = -1, max_y_px = -1;
};

struct Component {
    int place = 0;        ///< where number() expects its number
    int first_pixel = 0;  ///< map index of its first pixel, row by row
    int pixels = 0;
    int seeds = 0;     ///< pixels of MEMBER_SEED
    int unknowns = 0;  ///< pixels of MEMBER_UNKNOWN
    int expected = 0;  ///< pixels with MEMBER_EXPECTED
    PixelBox box;
    float mean_depth_m = 0.0f;
};

/// Depth-aware connected components (Fig 14c) of any map of members: the outlier map, the touch map.
class ConnectedComponents {
  public:
    ConnectedComponents(const Device& device, const ConnectedComponentsConfig& config, const MapShape& shape);

    /// `members`: ComponentMember per pixel, 0 where there is none; `depth_m` in metres, positive wherever
    /// there is a member. Waits for the device. Sorted by first_pixel; valid until the next call.
    const std::vector<Component>& find(const Buffer<std::uint8_t>& members, const Buffer<float>& depth_m);

    /// Numbers the components of the last find(): component i gets `number_of[i]` >= 0, or -1 where it is to
    /// be dropped. `labels` is the number per pixel, -1 = none; `mask` is 255 where there is a number.
    void number(std::span<const int> number_of, Buffer<int>& labels, Buffer<std::uint8_t>& mask);

  private:
    void read_components();

    const Device* device_;
    MapShape shape_;
    ConnectionParams params_;
    Program program_;
    Kernel label_runs_, merge_runs_, list_roots_, sum_components_, number_components_;
    Buffer<int> roots_, places_, count_, numbers_;
    Buffer<ComponentSums> sums_;
    std::vector<Component> components_;
};

}  // namespace touchstone
