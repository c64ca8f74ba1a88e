#include "tests/accuracy/mesh_picture.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

constexpr float nearest_m = 0.001f;

/// Camera axes: x right, y down, z forward.
Eigen::Isometry3f camera_from_mesh(const PictureConfig& config) {
    const Eigen::Vector3f forward = (config.look_at_m - config.eye_m).normalized();
    Eigen::Vector3f right = forward.cross(config.up);
    if (right.norm() < 1e-3f) right = forward.unitOrthogonal();
    right.normalize();
    Eigen::Matrix3f rows;
    rows << right.transpose(), forward.cross(right).transpose(), forward.transpose();
    Eigen::Isometry3f T_c_mesh = Eigen::Isometry3f::Identity();
    T_c_mesh.linear() = rows;
    T_c_mesh.translation() = -rows * config.eye_m;
    return T_c_mesh;
}

class Canvas {
  public:
    explicit Canvas(const PictureConfig& config)
        : image_{config.width_px, config.height_px, 3, {}},
          focal_px_(0.5f * static_cast<float>(config.width_px) / std::tan(0.5f * config.field_of_view_rad)) {
        const auto pixels =
            static_cast<std::size_t>(config.width_px) * static_cast<std::size_t>(config.height_px);
        image_.pixels.assign(pixels * 3, 24);
        inverse_depth_.assign(pixels, 0.0f);
    }

    void fill(const std::array<Eigen::Vector3f, 3>& corners_c, const std::array<std::uint8_t, 3>& color) {
        std::array<Eigen::Vector3f, 3> p;  // pixel, 1/z
        for (std::size_t k = 0; k < 3; ++k) {
            const Eigen::Vector3f& v = corners_c[k];
            if (v.z() < nearest_m) return;
            p[k] = {focal_px_ * v.x() / v.z() + 0.5f * static_cast<float>(image_.width_px - 1),
                    focal_px_ * v.y() / v.z() + 0.5f * static_cast<float>(image_.height_px - 1),
                    1.0f / v.z()};
        }
        const float area = side_of(p[0], p[1], p[2]);
        if (area == 0.0f) return;
        const auto range = [&](int axis, int size) {
            const auto [low, high] = std::minmax({p[0][axis], p[1][axis], p[2][axis]});
            const auto last = static_cast<float>(size - 1);
            return std::pair{static_cast<int>(std::ceil(std::clamp(low, 0.0f, last + 1.0f))),
                             static_cast<int>(std::floor(std::clamp(high, -1.0f, last)))};
        };
        const auto [first_x, last_x] = range(0, image_.width_px);
        const auto [first_y, last_y] = range(1, image_.height_px);
        for (int y = first_y; y <= last_y; ++y) {
            for (int x = first_x; x <= last_x; ++x) {
                const Eigen::Vector3f at(static_cast<float>(x), static_cast<float>(y), 0.0f);
                const float a = side_of(p[1], p[2], at) / area, b = side_of(p[2], p[0], at) / area;
                const float c = 1.0f - a - b;
                if (a < 0.0f || b < 0.0f || c < -1e-6f) continue;
                put(x, y, a * p[0].z() + b * p[1].z() + c * p[2].z(), color);
            }
        }
    }

    Image8 take() { return std::move(image_); }

  private:
    static float side_of(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& p) {
        return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
    }

    void put(int x, int y, float inverse_depth, const std::array<std::uint8_t, 3>& color) {
        const auto pixel = static_cast<std::size_t>(y * image_.width_px + x);
        if (inverse_depth <= inverse_depth_[pixel]) return;
        inverse_depth_[pixel] = inverse_depth;
        for (std::size_t channel = 0; channel < 3; ++channel)
            image_.pixels[pixel * 3 + channel] = color[channel];
    }

    Image8 image_;
    float focal_px_;
    std::vector<float> inverse_depth_;
};

std::array<std::uint8_t, 3> shaded(const Eigen::Vector3f& base, float brightness) {
    std::array<std::uint8_t, 3> color{};
    for (int channel = 0; channel < 3; ++channel) {
        color[static_cast<std::size_t>(channel)] =
            static_cast<std::uint8_t>(std::clamp(base[channel] * brightness, 0.0f, 255.0f));
    }
    return color;
}

Eigen::Vector3f base_color(const SurfaceMesh& mesh, const std::array<std::uint32_t, 3>& t, bool use_colors) {
    if (!use_colors || mesh.colors.empty()) return {205.0f, 210.0f, 215.0f};
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (const std::uint32_t vertex : t) {
        const auto [red, green, blue] = mesh.colors[vertex];
        sum += Eigen::Vector3f(red, green, blue) / 3.0f;
    }
    return sum;
}

}  // namespace

PictureConfig whole_mesh(const SurfaceMesh& mesh, const Eigen::Vector3f& direction,
                         const Eigen::Vector3f& up) {
    Eigen::AlignedBox3f box;
    for (const auto& vertex : mesh.vertices_g_m) box.extend(vertex);
    PictureConfig config;
    config.up = up;
    config.look_at_m = box.center();
    config.eye_m = box.center() + direction.normalized();
    const Eigen::Isometry3f T_c_mesh = camera_from_mesh(config);
    const float half_width = std::tan(0.5f * config.field_of_view_rad);
    const float half_height =
        half_width * static_cast<float>(config.height_px) / static_cast<float>(config.width_px);
    float distance_m = 0.0f;
    for (const auto& vertex : mesh.vertices_g_m) {
        const Eigen::Vector3f p = T_c_mesh * vertex;
        const float aside = std::max(std::abs(p.x()) / half_width, std::abs(p.y()) / half_height);
        distance_m = std::max(distance_m, 1.05f * aside + 1.0f - p.z());
    }
    config.eye_m = box.center() + direction.normalized() * distance_m;
    return config;
}

Image8 draw_mesh(const SurfaceMesh& mesh, const PictureConfig& config) {
    const Eigen::Isometry3f T_c_mesh = camera_from_mesh(config);
    Canvas canvas(config);
    for (const auto& t : mesh.triangles) {
        std::array<Eigen::Vector3f, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) corners[k] = T_c_mesh * mesh.vertices_g_m[t[k]];
        const Eigen::Vector3f turned = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        if (turned.squaredNorm() == 0.0f) continue;
        const float facing = -turned.normalized().dot(corners[0].normalized());
        const Eigen::Vector3f base =
            facing > 0.0f ? base_color(mesh, t, config.use_colors) : Eigen::Vector3f(170.0f, 60.0f, 50.0f);
        canvas.fill(corners, shaded(base, 0.2f + 0.8f * std::abs(facing)));
    }
    return canvas.take();
}

}  // namespace touchstone
