#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "pipeline/pose_solver.hpp"
#include "tests/reference/depth_map_conversion.hpp"
#include "tests/reference/listing_1.hpp"

/// Listing 1 and the sums of Eq 1 in plain C++, pixel by pixel, in double. Pictures are row-major without
/// padding.
namespace touchstone::reference {

/// The mean of pixels 2x and 2x + 1 is at 2x + 0.5, so a place u of the source is at (u - 0.5) / 2.
inline Intrinsics half_intrinsics(const Intrinsics& k) {
    return {0.5f * k.fx_px,
            0.5f * k.fy_px,
            0.5f * (k.cx_px - 0.5f),
            0.5f * (k.cy_px - 0.5f),
            k.width_px / 2,
            k.height_px / 2,
            {}};
}

/// Mean of those of 2x2 depths that are at most gap_per_m z behind the nearest.
inline Picture half_sample(const Picture& source, float gap_per_m) {
    Picture half{source.width_px / 2, source.height_px / 2, {}};
    for (int y = 0; y < half.height_px; ++y) {
        for (int x = 0; x < half.width_px; ++x) {
            std::vector<float> valid;
            for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
                if (source.at(2 * x + i, 2 * y + j) > 0.0f) valid.push_back(source.at(2 * x + i, 2 * y + j));
            }
            float sum = 0.0f, count = 0.0f;
            for (const float z : valid) {
                if (z > *std::ranges::min_element(valid) * (1.0f + gap_per_m)) continue;
                sum += z;
                count += 1.0f;
            }
            half.depth_m.push_back(count > 0.0f ? sum / count : 0.0f);
        }
    }
    return half;
}

/// The next level of a live picture; its normals are of the half-sized depths.
inline OrientedPicture half_sample(const OrientedPicture& source, const Intrinsics& half_k, float gap_per_m,
                                   float normal_gap_per_m) {
    const Picture half = half_sample(Picture{source.width_px, source.height_px, source.depth_m}, gap_per_m);
    OrientedPicture result{half.width_px, half.height_px, half.depth_m, {}};
    for (int y = 0; y < half.height_px; ++y) {
        for (int x = 0; x < half.width_px; ++x)
            result.normals.push_back(normal(half, half_k, x, y, normal_gap_per_m));
    }
    return result;
}

/// Brightness 0..1, row-major, of 3 bytes a pixel: Rec. 601.
inline std::vector<float> brightness(const std::vector<std::uint8_t>& rgb) {
    std::vector<float> values;
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3)
        values.push_back((0.299f * rgb[i] + 0.587f * rgb[i + 1] + 0.114f * rgb[i + 2]) / 255.0f);
    return values;
}

inline void add_row(AlignmentSums& sums, const Eigen::Vector3d& p, const Eigen::Vector3d& d, double r,
                    double w) {
    Vector6d j;
    j << p.cross(d), d;
    sums.A += w * j * j.transpose();
    sums.b += w * r * j;
    sums.weight += w;
    sums.weighted_squares += w * r * r;
    sums.squares += r * r;
    sums.pairs += 1.0;
}

inline Eigen::Vector3d point_c(const Intrinsics& k, double x, double y, double z) {
    return z * Eigen::Vector3d((x - k.cx_px) / k.fx_px, (y - k.cy_px) / k.fy_px, 1.0);
}

/// Row-major index of the nearest pixel, or -1: behind the camera or outside.
inline int nearest_pixel(const Intrinsics& k, const Eigen::Vector3d& v) {
    if (v.z() <= 0.05) return -1;
    const double u = std::floor(v.x() / v.z() * k.fx_px + k.cx_px + 0.5);
    const double w = std::floor(v.y() / v.z() * k.fy_px + k.cy_px + 0.5);
    if (u < 0.0 || w < 0.0 || u >= k.width_px || w >= k.height_px) return -1;
    return static_cast<int>(w) * k.width_px + static_cast<int>(u);
}

/// sigma_z(z, theta), metres, with the grazing term as the kernels have it: 2 tan^2 instead of Nguyen's.
inline double sigma_m(const SensorNoise& noise, double z, double cos_theta) {
    const double cos2 = std::max(cos_theta * cos_theta, 0.01);
    return noise.constant_m + noise.quadratic * std::pow(z - noise.offset_m, 2.0) +
           noise.grazing / std::sqrt(z) * 2.0 * (1.0 / cos2 - 1.0);
}

inline Eigen::Vector3d centre_of(const AlignmentParams& params) {
    return {params.centre_p.x, params.centre_p.y, params.centre_p.z};
}

/// The mean of a picture's points, about which twists turn; `levels` times half-sampled.
inline Eigen::Vector3f middle_of(OrientedPicture picture, Intrinsics k, int levels, float gap_per_m) {
    for (int level = 0; level < levels; ++level) {
        k = half_intrinsics(k);
        picture = half_sample(picture, k, gap_per_m, gap_per_m);
    }
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0.0;
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const float z = picture.depth_m[static_cast<std::size_t>(y * k.width_px + x)];
            if (z <= 0.0f) continue;
            sum += point_c(k, x, y, static_cast<double>(z));
            count += 1.0;
        }
    }
    return count > 0.0 ? Eigen::Vector3f((sum / count).cast<float>()) : Eigen::Vector3f::UnitZ();
}

/// Huber's weight, limited by Tukey's, which is 0 at the cut-off; of a residual in sigmas.
inline double robust_weight(const AlignmentParams& params, double sigmas) {
    const double huber = std::min(1.0, params.huber_sigmas / std::max(sigmas, 1e-12));
    return huber * std::pow(1.0 - std::pow(sigmas / params.cutoff_sigmas, 2.0), 2.0);
}

/// The sums of one level; `model` is of the full size, whatever the level of `live`.
inline AlignmentSums sum_alignment(const OrientedPicture& live, const Intrinsics& live_k,
                                   const OrientedPicture& model, const Intrinsics& model_k,
                                   const RigidTransform& T_p_c, const AlignmentParams& params) {
    AlignmentSums sums;
    const Eigen::Isometry3d T = T_p_c.cast<double>();
    for (int y = 0; y < live.height_px; ++y) {
        for (int x = 0; x < live.width_px; ++x) {
            const auto u = static_cast<std::size_t>(y * live.width_px + x);
            if (live.depth_m[u] <= 0.0f) continue;
            sums.measured += 1.0;
            const Eigen::Vector3d v = T * point_c(live_k, x, y, static_cast<double>(live.depth_m[u]));
            const int pixel = nearest_pixel(model_k, v);
            if (pixel < 0 || model.depth_m[static_cast<std::size_t>(pixel)] <= 0.0f) continue;
            sums.compared += 1.0;
            const auto at = static_cast<std::size_t>(pixel);
            const Eigen::Vector3d v_model = point_c(model_k, pixel % model.width_px, pixel / model.width_px,
                                                    static_cast<double>(model.depth_m[at]));
            const Eigen::Vector3d n = model.normals[at].cast<double>();
            const double r = n.dot(v_model - v);
            const double sigma = sigma_m(params.noise, v.z(), n.dot(v.normalized()));
            if ((v_model - v).norm() >= params.max_distance_m) continue;
            if (n.dot(T.linear() * live.normals[u].cast<double>()) <= params.min_normal_cos) continue;
            const double sigmas = std::abs(r) / sigma;
            if (sigmas >= params.cutoff_sigmas) continue;
            if (sigmas < 2.0) sums.close += 1.0;
            add_row(sums, v - centre_of(params), n, r,
                    std::pow(params.reference_sigma_m / sigma, 2.0) * robust_weight(params, sigmas));
        }
    }
    return sums;
}

/// Brightness of a level, 0 = finest, of both cameras.
struct Brightness {
    int level = 0;
    int width_px = 0, height_px = 0;
    std::vector<float> live, model;

    /// The model's at a place of the level between pixel centres: bilinear.
    double at(double u, double v) const {
        const int x = static_cast<int>(std::floor(u)), y = static_cast<int>(std::floor(v));
        const auto value = [&](int i, int j) {
            return static_cast<double>(model[static_cast<std::size_t>((y + j) * width_px + x + i)]);
        };
        return std::lerp(std::lerp(value(0, 0), value(1, 0), u - x),
                         std::lerp(value(0, 1), value(1, 1), u - x), v - y);
    }
    bool contains(double u, double v) const {
        return u >= 0.0 && v >= 0.0 && u < width_px - 1 && v < height_px - 1;
    }
};

/// What the live pixel shows, less what the model's camera saw of the point; J is the derivative of the
/// bilinear interpolation within its cell, here by differences.
inline AlignmentSums sum_intensity(const OrientedPicture& live, const Intrinsics& live_k,
                                   const OrientedPicture& model, const Intrinsics& model_k,
                                   const Brightness& seen, const RigidTransform& T_p_c,
                                   const AlignmentParams& params) {
    AlignmentSums sums;
    const Eigen::Isometry3d T = T_p_c.cast<double>();
    const double scale = 1.0 / (1 << seen.level);
    for (int y = 0; y < live.height_px; ++y) {
        for (int x = 0; x < live.width_px; ++x) {
            const auto i = static_cast<std::size_t>(y * live.width_px + x);
            if (live.depth_m[i] <= 0.0f) continue;
            const Eigen::Vector3d v = T * point_c(live_k, x, y, static_cast<double>(live.depth_m[i]));
            const int pixel = nearest_pixel(model_k, v);
            const double model_m = pixel < 0 ? 0.0 : model.depth_m[static_cast<std::size_t>(pixel)];
            if (model_m <= 0.0 || std::abs(model_m - v.z()) >= params.max_distance_m) continue;
            const auto place = [&](const Eigen::Vector3d& p) -> Eigen::Vector2d {
                return {(p.x() / p.z() * model_k.fx_px + model_k.cx_px + 0.5) * scale - 0.5,
                        (p.y() / p.z() * model_k.fy_px + model_k.cy_px + 0.5) * scale - 0.5};
            };
            const Eigen::Vector2d at = place(v);
            if (!seen.contains(at.x(), at.y())) continue;
            // The slopes within the cell, extended beyond it: bilinear is linear along each axis.
            const double x0 = std::floor(at.x()), y0 = std::floor(at.y()), eps = 1e-6;
            const double du = (seen.at(x0 + 1.0 - eps, at.y()) - seen.at(x0, at.y())) / (1.0 - eps);
            const double dv = (seen.at(at.x(), y0 + 1.0 - eps) - seen.at(at.x(), y0)) / (1.0 - eps);
            Eigen::Vector3d d;
            for (int axis = 0; axis < 3; ++axis) {
                const Eigen::Vector3d step = 1e-6 * Eigen::Vector3d::Unit(axis);
                const Eigen::Vector2d slope = (place(v + step) - place(v - step)) / 2e-6;
                d[axis] = -(du * slope.x() + dv * slope.y());
            }
            const double r = seen.at(at.x(), at.y()) - static_cast<double>(seen.live[i]);
            const double huber =
                std::min(1.0, params.huber_sigmas * params.intensity_sigma / std::max(std::abs(r), 1e-12));
            add_row(sums, v - centre_of(params), d, r,
                    std::pow(params.reference_sigma_m / params.intensity_sigma, 2.0) * huber);
        }
    }
    return sums;
}

}  // namespace touchstone::reference
