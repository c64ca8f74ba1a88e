#include "app/frame_ring.hpp"

#include <stdexcept>
#include <zstd.h>

namespace touchstone {

namespace {

constexpr int fastest_usual_level = 1;

std::size_t checked(std::size_t size) {
    if (ZSTD_isError(size) != 0)
        throw std::runtime_error(std::string("a depth frame cannot be packed: ") + ZSTD_getErrorName(size));
    return size;
}

}  // namespace

bool FrameRing::goes_on(const DepthFrame& frame) const {
    const Packed& last = packed_.back();
    return frame.width_px == intrinsics_.width_px && frame.height_px == intrinsics_.height_px &&
           frame.index > last.index && frame.timestamp_us >= last.timestamp_us;
}

void FrameRing::add(const DepthFrame& frame) {
    if (!packed_.empty() && !goes_on(frame)) clear();
    intrinsics_ = frame.intrinsics;
    packed_.push_back({frame.index, frame.timestamp_us, pack(frame.depth_mm)});
    bytes_ += packed_.back().data.size();
    const auto too_old = [&](const Packed& oldest) {
        return static_cast<double>(frame.timestamp_us - oldest.timestamp_us) > 1e6 * span_s_;
    };
    while (!packed_.empty() && (too_old(packed_.front()) || bytes_ > most_bytes_)) {
        bytes_ -= packed_.front().data.size();
        packed_.pop_front();
    }
}

void FrameRing::clear() {
    packed_.clear();
    bytes_ = 0;
}

/// Apart, the bytes of a pixel take half the time of depths as they lie, and a little less memory.
std::string FrameRing::pack(const std::vector<std::uint16_t>& depth_mm) {
    const std::size_t pixels = depth_mm.size();
    planes_.resize(2 * pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        planes_[i] = static_cast<char>(depth_mm[i] & 0xff);
        planes_[pixels + i] = static_cast<char>(depth_mm[i] >> 8);
    }
    compressed_.resize(ZSTD_compressBound(planes_.size()));
    const std::size_t size = ZSTD_compress(compressed_.data(), compressed_.size(), planes_.data(),
                                           planes_.size(), fastest_usual_level);
    return compressed_.substr(0, checked(size));
}

DepthFrame FrameRing::frame(std::size_t place) const {
    const Packed& packed = packed_.at(place);
    const auto pixels =
        static_cast<std::size_t>(intrinsics_.width_px) * static_cast<std::size_t>(intrinsics_.height_px);
    std::string planes(2 * pixels, '\0');
    checked(ZSTD_decompress(planes.data(), planes.size(), packed.data.data(), packed.data.size()));
    std::vector<std::uint16_t> depth_mm(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const auto low = static_cast<unsigned char>(planes[i]);
        const auto high = static_cast<unsigned char>(planes[pixels + i]);
        depth_mm[i] = static_cast<std::uint16_t>(high << 8 | low);
    }
    return {packed.index,
            packed.timestamp_us,
            intrinsics_.width_px,
            intrinsics_.height_px,
            intrinsics_,
            std::move(depth_mm),
            {}};
}

}  // namespace touchstone
