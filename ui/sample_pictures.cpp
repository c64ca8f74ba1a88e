#include "ui/sample_pictures.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace touchstone {

namespace {

using Eigen::Vector3f;  // red, green, blue, 0..1

constexpr int width_px = 600, height_px = 420;
constexpr float aspect = static_cast<float>(width_px) / height_px;

Vector3f mix(const Vector3f& a, const Vector3f& b, float share) {
    return a + std::clamp(share, 0.f, 1.f) * (b - a);
}

float smooth(float from, float to, float x) {
    const float t = std::clamp((x - from) / (to - from), 0.f, 1.f);
    return t * t * (3.f - 2.f * t);
}

float scattered(int x, int y) {
    auto n = static_cast<std::uint32_t>(x) * 0x9E3779B1U + static_cast<std::uint32_t>(y) * 0x85EBCA77U;
    n = (n ^ (n >> 15)) * 0x2C1B3C6DU;
    return static_cast<float>((n ^ (n >> 13)) & 0xFFFFU) / 65536.f;
}

/// A crest line: smooth near hills, rough far ones.
float ridge(float x, float seed, float roughness) {
    float height = 0.f, share = 0.5f, often = 1.7f;
    for (int octave = 0; octave < 6; ++octave) {
        height += share * std::sin(often * x + seed * static_cast<float>(octave + 1));
        share *= roughness;
        often *= 2.1f;
    }
    return height;
}

/// 1 on a crisp disc, with a soft edge of a pixel.
float disc(float x, float y, float cx, float cy, float radius) {
    return 1.f - smooth(radius - 0.004f, radius, std::hypot(x - cx, y - cy));
}

Vector3f hills_at_dusk(float x, float y) {
    Vector3f color = mix({0.25f, 0.2f, 0.45f}, {1.f, 0.62f, 0.32f}, smooth(0.f, 0.62f, y));
    const float from_sun = std::hypot(x - 0.98f, y - 0.5f);
    color = mix(color, {1.f, 0.85f, 0.5f}, 0.9f * std::exp(-5.f * from_sun));
    color = mix(color, {1.f, 0.97f, 0.85f}, disc(x, y, 0.98f, 0.5f, 0.085f));
    for (int layer = 0; layer < 5; ++layer) {
        const auto l = static_cast<float>(layer);
        const float crest = 0.55f + 0.1f * l + 0.085f * ridge((1.f + 0.35f * l) * x, 1.7f + 2.3f * l, 0.45f);
        const Vector3f near = mix({0.72f, 0.4f, 0.45f}, {0.1f, 0.07f, 0.16f}, l / 4.f);
        const float haze = 1.f - smooth(0.f, 0.22f, y - crest);
        color = mix(color, mix(near, {0.95f, 0.6f, 0.42f}, 0.28f * haze * (1.f - l / 5.f)),
                    smooth(crest - 0.003f, crest, y));
    }
    return color;
}

Vector3f night_sky(float x, float y) {
    Vector3f color = mix({0.03f, 0.05f, 0.14f}, {0.22f, 0.34f, 0.52f}, smooth(0.f, 0.62f, y));
    const auto px = static_cast<int>(x * height_px), py = static_cast<int>(y * height_px);
    if (scattered(px, py) > 0.9985f) color += Vector3f::Constant(0.7f * scattered(py, px) * (1.f - y));
    const float from_moon = std::hypot(x - 0.4f, y - 0.2f);
    color += Vector3f(0.5f, 0.52f, 0.5f) * std::exp(-9.f * from_moon);
    return mix(color, {0.98f, 0.96f, 0.88f}, disc(x, y, 0.4f, 0.2f, 0.062f));
}

Vector3f shore(float x, float y) {
    Vector3f color = night_sky(x, y);
    for (int layer = 0; layer < 2; ++layer) {
        const auto l = static_cast<float>(layer);
        const float crest = 0.46f + 0.08f * l - 0.16f * ridge(1.1f * x + l, 3.1f + 2.2f * l, 0.55f);
        const float light = 0.25f * ridge(9.f * x - 7.f * y, 1.f, 0.7f);
        const Vector3f rock = mix({0.2f, 0.28f, 0.42f}, {0.07f, 0.1f, 0.18f}, l);
        color = mix(color, rock * (1.f + light * (1.f - l)), smooth(crest - 0.003f, crest, y));
    }
    return color;
}

Vector3f lake_by_moonlight(float x, float y) {
    constexpr float water = 0.62f;
    if (y < water) return shore(x, y);
    const float depth = (y - water) / (1.f - water);
    const float ripple =
        0.012f * std::sin(90.f * std::pow(depth, 0.6f) + 6.f * std::sin(7.f * x)) * (0.3f + depth);
    const Vector3f mirrored = shore(x + ripple, water - 0.9f * (y - water) + ripple);
    return mix(mirrored * 0.8f, {0.04f, 0.08f, 0.17f}, 0.25f + 0.5f * depth);
}

Vector3f aurora(float x, float y) {
    Vector3f color = mix({0.02f, 0.03f, 0.1f}, {0.05f, 0.16f, 0.22f}, y);
    const auto px = static_cast<int>(x * height_px), py = static_cast<int>(y * height_px);
    if (scattered(px + 911, py) > 0.998f) color += Vector3f::Constant(0.6f * scattered(py, px));
    for (int curtain = 0; curtain < 3; ++curtain) {
        const auto c = static_cast<float>(curtain);
        const float foot = 0.52f - 0.09f * c + 0.09f * ridge(1.9f * x + 1.3f * c, 0.8f + c, 0.4f);
        const float up = foot - y;
        const float strands = 0.72f + 0.28f * std::sin(38.f * x + 9.f * ridge(5.f * x, 2.f + c, 0.5f));
        const float glow = (up > 0.f ? std::exp(-5.2f * up) : std::exp(38.f * up)) * strands;
        const Vector3f tint = mix({0.16f, 0.95f, 0.55f}, {0.6f, 0.25f, 0.9f}, smooth(0.04f, 0.34f, up));
        color += 0.62f * glow * tint;
    }
    const float snow = 0.78f + 0.035f * ridge(1.4f * x, 5.f, 0.4f);
    const Vector3f ground = mix({0.26f, 0.5f, 0.5f}, {0.07f, 0.16f, 0.24f}, smooth(snow, 1.f, y));
    color = mix(color, ground, smooth(snow - 0.003f, snow, y));
    const float cell = std::floor(x * 26.f), within = x * 26.f - cell - 0.5f;
    const float tall = 0.06f + 0.13f * scattered(static_cast<int>(cell), 7);
    const float along = (y - (snow + 0.02f - tall)) / tall;
    const bool is_tree = scattered(static_cast<int>(cell), 3) > 0.3f && along > 0.f && along < 1.f;
    const float wide = 0.46f * along * (0.75f + 0.25f * std::sin(26.f * along));
    return is_tree && std::abs(within) < wide ? Vector3f(0.02f, 0.05f, 0.08f) : color;
}

Vector3f sea(float x, float y) {
    Vector3f color = mix({0.36f, 0.68f, 0.9f}, {0.98f, 0.9f, 0.78f}, smooth(0.f, 0.5f, y));
    color = mix(color, {1.f, 0.98f, 0.9f}, disc(x, y, 0.42f, 0.24f, 0.075f));
    for (int wave = 0; wave < 7; ++wave) {
        const auto w = static_cast<float>(wave);
        const float crest = 0.46f + 0.085f * w +
                            0.016f * (1.f + 0.4f * w) * std::sin((9.f - 0.7f * w) * x + 1.9f * w) +
                            0.008f * std::sin(17.f * x + 2.f * w);
        const Vector3f water = mix({0.36f, 0.75f, 0.82f}, {0.03f, 0.2f, 0.38f}, w / 6.f);
        const float foam = 1.f - smooth(0.003f, 0.012f + 0.002f * w, y - crest);
        color = mix(color, mix(water, {0.96f, 0.99f, 1.f}, 0.75f * foam), smooth(crest - 0.003f, crest, y));
    }
    return color;
}

template <class Scenery>
Picture painted(Scenery scenery) {
    Picture picture{width_px, height_px, {}};
    picture.rgba.reserve(static_cast<std::size_t>(width_px) * height_px * 4);
    for (int y = 0; y < height_px; ++y)
        for (int x = 0; x < width_px; ++x) {
            const Vector3f color = scenery(aspect * (static_cast<float>(x) + 0.5f) / width_px,
                                           (static_cast<float>(y) + 0.5f) / height_px);
            for (int channel = 0; channel < 3; ++channel)
                picture.rgba.push_back(
                    static_cast<std::uint8_t>(255.f * std::clamp(color[channel], 0.f, 1.f) + 0.5f));
            picture.rgba.push_back(255);
        }
    return picture;
}

}  // namespace

std::vector<Picture> sample_pictures() {
    return {painted(hills_at_dusk), painted(lake_by_moonlight), painted(aurora), painted(sea)};
}

}  // namespace touchstone
