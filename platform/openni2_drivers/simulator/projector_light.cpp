#include "platform/openni2_drivers/simulator/projector_light.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "platform/openni2_drivers/simulator/random.hpp"

namespace touchstone::sim {
namespace {

constexpr float cell_px = 4.0F;          // of the picture in which shadows are found
constexpr float shadow_bias_m = 0.012F;  // what lies so much deeper in a cell is still lit
constexpr float footprint_px = 0.9F;     // half a camera's pixel in the picture, about
constexpr int taps = 3;                  // across and down a camera's pixel
constexpr float step_px = 2.0F * footprint_px / static_cast<float>(taps);
constexpr float noise_levels = 2.0F;
constexpr float white = 0.75F;  // of full room light, at a metre from the projector

int cells(int pixels) { return static_cast<int>(std::ceil(static_cast<float>(pixels) / cell_px)); }

/// Noise of a frame's pixels: sums of two uniform numbers, cheap and the same everywhere.
class LevelNoise {
  public:
    LevelNoise(std::uint64_t seed, int frame)
        : state_(mix64(mix64(seed) ^ static_cast<std::uint64_t>(frame))) {}
    float next() {
        state_ = state_ * 6364136223846793005U + 1442695040888963407U;
        const auto a = static_cast<float>((state_ >> 40) & 0xffffU), b = static_cast<float>(state_ >> 48);
        return noise_levels * 2.45F * ((a + b) / 65536.0F - 1.0F);
    }

  private:
    std::uint64_t state_;
};

}  // namespace

void ProjectorLight::find_places(const std::vector<float>& depth_m, const TableView& view) {
    const Intrinsics& k = view.intrinsics;
    const auto width = static_cast<float>(projector_.width_px),
               height = static_cast<float>(projector_.height_px);
    places_.assign(depth_m.size(), {});
    for (std::size_t i = 0; i < depth_m.size(); ++i) {
        if (!std::isfinite(depth_m[i]) || depth_m[i] <= 0.0F) continue;
        const auto pixel = static_cast<int>(i);
        const int x = pixel % k.width_px, y = pixel / k.width_px;
        const Vec3 ray_c = view.ray_c(static_cast<float>(x), static_cast<float>(y));
        const Vec3 point_s = view.to_scene(ray_c * depth_m[i]);
        const float along_m = projector_.depth_m(point_s);
        if (along_m < 0.05F) continue;
        const Eigen::Vector2f at = projector_.pixel_px(point_s);
        const bool inside =
            at.x() >= -0.5F && at.y() >= -0.5F && at.x() < width - 0.5F && at.y() < height - 0.5F;
        if (inside) places_[i] = {at.x(), at.y(), along_m};
    }
}

void ProjectorLight::find_shadows() {
    const int across = cells(projector_.width_px);
    nearest_m_.assign(static_cast<std::size_t>(across * cells(projector_.height_px)),
                      std::numeric_limits<float>::infinity());
    for (const LitPlace& place : places_) {
        if (place.depth_m == 0.0F) continue;
        const int x = static_cast<int>((place.x_px + 0.5F) / cell_px),
                  y = static_cast<int>((place.y_px + 0.5F) / cell_px);
        float& nearest = nearest_m_[static_cast<std::size_t>(y * across + x)];
        nearest = std::min(nearest, place.depth_m);
    }
}

bool ProjectorLight::is_in_shadow(const LitPlace& place) const {
    const int x = static_cast<int>((place.x_px + 0.5F) / cell_px),
              y = static_cast<int>((place.y_px + 0.5F) / cell_px);
    const float nearest = nearest_m_[static_cast<std::size_t>(y * cells(projector_.width_px) + x)];
    return place.depth_m > nearest + shadow_bias_m;
}

/// 0..1 a channel, the mean over the camera's pixel.
Vec3 ProjectorLight::thrown_light(const LitPlace& place, const ProjectedPicture& picture) const {
    const float stretch_x = static_cast<float>(picture.width_px) / static_cast<float>(projector_.width_px);
    const float stretch_y = static_cast<float>(picture.height_px) / static_cast<float>(projector_.height_px);
    Vec3 sum = Vec3::Zero();
    for (int j = 0; j < taps; ++j) {
        for (int i = 0; i < taps; ++i) {
            const int across = i - taps / 2, down = j - taps / 2;
            const float x_px = place.x_px + step_px * static_cast<float>(across);
            const float y_px = place.y_px + step_px * static_cast<float>(down);
            const int x = std::clamp(static_cast<int>((x_px + 0.5F) * stretch_x), 0, picture.width_px - 1);
            const int y = std::clamp(static_cast<int>((y_px + 0.5F) * stretch_y), 0, picture.height_px - 1);
            const std::uint8_t* rgba = &picture.rgba[4 * static_cast<std::size_t>(y * picture.width_px + x)];
            sum += Vec3(rgba[0], rgba[1], rgba[2]);
        }
    }
    return sum / (255.0F * taps * taps);
}

void ProjectorLight::shine(std::vector<std::uint8_t>& color_rgb, const std::vector<float>& depth_m,
                           const TableView& view, const ProjectedPicture* picture, int frame) {
    if (picture) {
        find_places(depth_m, view);
        find_shadows();
    }
    LevelNoise noise(seed_, frame);
    for (std::size_t i = 0; i < depth_m.size(); ++i) {
        Vec3 light = Vec3::Constant(ambient_);
        if (picture && places_[i].depth_m > 0.0F && !is_in_shadow(places_[i])) {
            const float fall_off = 1.0F / std::max(0.25F, places_[i].depth_m * places_[i].depth_m);
            light += white * fall_off * thrown_light(places_[i], *picture);
        }
        for (std::size_t channel = 0; channel < 3; ++channel) {
            std::uint8_t& value = color_rgb[3 * i + channel];
            const float level =
                static_cast<float>(value) * light[static_cast<Eigen::Index>(channel)] + noise.next();
            value = static_cast<std::uint8_t>(std::clamp(level + 0.5F, 0.0F, 255.0F));
        }
    }
}

}  // namespace touchstone::sim
