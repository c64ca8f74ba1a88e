#include "pipeline/connected_components.hpp"

#include <algorithm>

#include "pipeline/kernel_program.hpp"

namespace touchstone {

namespace {

/// Depth steps can part every pixel from its neighbours.
std::size_t most_components(const MapShape& shape) { return map_pixels(shape); }

Component to_component(const ComponentSums& sums, std::size_t place) {
    const double depth_sum_mm = 65536.0 * sums.depth_mm_high + sums.depth_mm_low;
    return {static_cast<int>(place),
            sums.root,
            sums.pixels,
            sums.seeds,
            sums.unknowns,
            sums.expected,
            {sums.min_x, sums.min_y, sums.max_x, sums.max_y},
            static_cast<float>(0.001 * depth_sum_mm / std::max(1, sums.pixels))};
}

}  // namespace

ConnectedComponents::ConnectedComponents(const Device& device, const ConnectedComponentsConfig& config,
                                         const MapShape& shape)
    : device_(&device),
      shape_(shape),
      params_{config.noise, config.gap_sigmas, config.gap_per_m},
      program_(load_kernel_program(device, "connected_components.cl")),
      label_runs_(program_.kernel("label_runs")),
      merge_runs_(program_.kernel("merge_runs")),
      list_roots_(program_.kernel("list_roots")),
      sum_components_(program_.kernel("sum_components")),
      number_components_(program_.kernel("number_components")),
      roots_(device, map_pixels(shape)),
      places_(device, map_pixels(shape)),
      count_(device, 1),
      numbers_(device, 64),
      sums_(device, most_components(shape)) {}

const std::vector<Component>& ConnectedComponents::find(const Buffer<std::uint8_t>& members,
                                                        const Buffer<float>& depth_m) {
    const LaunchSize size = eight_pixels_each(shape_);
    count_.fill(0);
    label_runs_.launch(size, members, depth_m, roots_, shape_, params_);
    merge_runs_.launch(size, members, depth_m, roots_, shape_, params_);
    list_roots_.launch(size, roots_, places_, sums_, count_, shape_);
    const LaunchSize halves{{static_cast<std::size_t>(shape_.pitch_px / 8),
                             static_cast<std::size_t>(shape_.rows_px / TILE_PX), 1}};
    sum_components_.launch(halves, members, depth_m, roots_, places_, sums_, shape_);
    read_components();
    return components_;
}

void ConnectedComponents::read_components() {
    components_.clear();
    const auto count = static_cast<std::size_t>(count_.map_read()[0]);
    if (count == 0) return;
    const auto sums = sums_.map_read(count);
    for (std::size_t place = 0; place < count; ++place)
        components_.push_back(to_component(sums[place], place));
    std::ranges::sort(components_, {}, &Component::first_pixel);
}

void ConnectedComponents::number(std::span<const int> number_of, Buffer<int>& labels,
                                 Buffer<std::uint8_t>& mask) {
    if (numbers_.size() < number_of.size()) numbers_ = Buffer<int>(*device_, 2 * number_of.size());
    {
        const auto numbers = numbers_.map_write();
        for (std::size_t i = 0; i < number_of.size(); ++i)
            numbers[static_cast<std::size_t>(components_[i].place)] = number_of[i];
    }
    number_components_.launch(eight_pixels_each(shape_), roots_, places_, numbers_, labels, mask, shape_);
}

}  // namespace touchstone
