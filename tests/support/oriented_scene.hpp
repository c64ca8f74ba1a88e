#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "pipeline/maps.hpp"
#include "pipeline/types.hpp"
#include "tests/reference/listing_1.hpp"
#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"

/// Exact depths and exact normals of scenes made of planes and spheres, for tracking tests.
namespace touchstone::test {

/// t: along the ray in units of its direction's length, 0 = nothing met; n: unit, either side.
struct Hit {
    double t = 0.0;
    Eigen::Vector3d n_g = Eigen::Vector3d::Zero();
};
using OrientedSurface = std::function<Hit(const Eigen::Vector3d& origin_g, const Eigen::Vector3d& ray_g)>;

/// Plane n . p = d, global frame.
inline OrientedSurface wall(const Eigen::Vector3d& n, double d_m) {
    return [unit = n.normalized().eval(), d_m](const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) {
        const double t = (d_m - unit.dot(origin)) / unit.dot(ray);
        return std::isfinite(t) && t > 0.0 ? Hit{t, unit} : Hit{};
    };
}

inline OrientedSurface ball(const Eigen::Vector3d& center_g, double radius_m) {
    return [=](const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) {
        const Eigen::Vector3d o = origin - center_g;
        const double a = ray.squaredNorm(), b = ray.dot(o), c = o.squaredNorm() - radius_m * radius_m;
        const double discriminant = b * b - a * c;
        const double t = discriminant > 0.0 ? (-b - std::sqrt(discriminant)) / a : 0.0;
        return t > 0.0 ? Hit{t, (o + t * ray) / radius_m} : Hit{};
    };
}

inline OrientedSurface nearest_of(const std::vector<OrientedSurface>& surfaces) {
    return [=](const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) {
        Hit best;
        for (const OrientedSurface& surface : surfaces) {
            const Hit hit = surface(origin, ray);
            if (hit.t > 0.0 && (best.t <= 0.0 || hit.t < best.t)) best = hit;
        }
        return best;
    };
}

/// Three walls that meet 1.5 m before a camera at the origin that looks along z, `tilt_deg` from facing it:
/// they constrain all six directions.
inline OrientedSurface three_walls(double tilt_deg = 30.0) {
    const Eigen::Vector3d apex(0.03, 0.02, 1.5);
    const double degree = std::numbers::pi / 180.0;
    std::vector<OrientedSurface> walls;
    for (const double azimuth_deg : {20.0, 140.0, 260.0}) {
        const double x = std::sin(tilt_deg * degree);
        const Eigen::Vector3d n(x * std::cos(azimuth_deg * degree), x * std::sin(azimuth_deg * degree),
                                std::cos(tilt_deg * degree));
        walls.push_back(wall(n, n.dot(apex)));
    }
    return nearest_of(walls);
}

/// The same with a ball before them.
inline OrientedSurface corner() { return nearest_of({three_walls(), ball({0.15, 0.1, 1.05}, 0.15)}); }

/// What the camera at T_g_c sees; normals in the camera frame, facing it.
inline reference::OrientedPicture view_of(const Intrinsics& k, const OrientedSurface& scene,
                                          const RigidTransform& T_g_c) {
    reference::OrientedPicture picture{k.width_px, k.height_px, {}, {}};
    const Eigen::Isometry3d T = T_g_c.cast<double>();
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const Eigen::Vector3d ray_c = pixel_ray(k, x, y).cast<double>();
            const Hit hit = scene(T.translation(), T.linear() * ray_c);
            const Eigen::Vector3d n_c = T.linear().transpose() * hit.n_g;
            picture.depth_m.push_back(static_cast<float>(hit.t));
            picture.normals.push_back((n_c.dot(ray_c) > 0.0 ? -n_c : n_c).cast<float>());
        }
    }
    return picture;
}

/// Without depth and normal where `is_hole(x, y)`.
inline void make_holes(reference::OrientedPicture& picture, const std::function<bool(int, int)>& is_hole) {
    for (int y = 0; y < picture.height_px; ++y) {
        for (int x = 0; x < picture.width_px; ++x) {
            if (!is_hole(x, y)) continue;
            const auto at = static_cast<std::size_t>(y * picture.width_px + x);
            picture.depth_m[at] = 0.0f;
            picture.normals[at].setZero();
        }
    }
}

inline std::vector<float> normal_planes(const MapShape& shape, const reference::OrientedPicture& picture) {
    std::vector<float> planes(3 * map_pixels(shape), 0.0f);
    for (int y = 0; y < picture.height_px; ++y) {
        for (int x = 0; x < picture.width_px; ++x) {
            for (int plane = 0; plane < 3; ++plane) {
                planes[static_cast<std::size_t>(plane) * map_pixels(shape) + map_index(shape, x, y)] =
                    picture.normals[static_cast<std::size_t>(y * picture.width_px + x)](plane);
            }
        }
    }
    return planes;
}

inline void write_live(const reference::OrientedPicture& picture, LiveMaps& live) {
    live.depth_m.write(padded<float>(live.shape, picture.depth_m));
    live.filtered_m.write(padded<float>(live.shape, picture.depth_m));
    live.normals_c.write(normal_planes(live.shape, picture));
}

inline void write_model(const reference::OrientedPicture& picture, SurfacePrediction& model) {
    model.depth_m.write(padded<float>(model.shape, picture.depth_m));
    model.normals_c.write(normal_planes(model.shape, picture));
}

/// A movement: millimetres, and degrees about `axis`.
inline RigidTransform moved(const Eigen::Vector3f& by_mm, float angle_deg = 0.0f,
                            const Eigen::Vector3f& axis = Eigen::Vector3f(1.0f, -2.0f, 0.7f)) {
    RigidTransform T = RigidTransform::Identity();
    T.translate(0.001f * by_mm);
    T.rotate(Eigen::AngleAxisf(angle_deg * std::numbers::pi_v<float> / 180.0f, axis.normalized()));
    return T;
}

struct PoseError {
    float mm = 0.0f, deg = 0.0f;
};

/// How far `T` is from the truth, as a movement of the camera.
inline PoseError pose_error(const RigidTransform& T, const RigidTransform& truth) {
    const RigidTransform rest = truth.inverse() * T;
    return {1000.0f * rest.translation().norm(),
            Eigen::AngleAxisf(rest.linear()).angle() * 180.0f / std::numbers::pi_v<float>};
}

}  // namespace touchstone::test
