#include "tests/accuracy/baselines/blobs.hpp"

namespace touchstone::baselines {
namespace {

/// The blob around a pixel; takes it from the mask.
Blob take_blob(Mask& left, std::size_t first) {
    Blob blob{first};
    left.values[first] = 0;
    for (std::size_t next = 0; next < blob.size(); ++next) {
        for_each_neighbour(left, blob[next], [&](std::size_t i) {
            if (left.values[i] == 0) return;
            left.values[i] = 0;
            blob.push_back(i);
        });
    }
    return blob;
}

}  // namespace

std::vector<Blob> find_blobs(const Mask& mask, std::size_t least_px) {
    std::vector<Blob> blobs;
    Mask left = mask;
    for (std::size_t i = 0; i < left.values.size(); ++i) {
        if (left.values[i] == 0) continue;
        Blob blob = take_blob(left, i);
        if (blob.size() >= least_px) blobs.push_back(std::move(blob));
    }
    return blobs;
}

Eigen::Vector2d centroid_px(const Blob& blob, int width_px) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    const auto width = static_cast<std::size_t>(width_px);
    for (const std::size_t i : blob)
        sum += Eigen::Vector2d(static_cast<double>(i % width), static_cast<double>(i / width));
    return sum / static_cast<double>(blob.size());
}

}  // namespace touchstone::baselines
