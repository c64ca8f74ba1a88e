#include "tests/accuracy/surface_score.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <numeric>

#include "tests/accuracy/distance_to_mesh.hpp"

namespace touchstone {
namespace {

std::vector<double> distances_mm(const std::vector<Eigen::Vector3f>& points, const DistanceToMesh& mesh) {
    std::vector<double> distances;
    distances.reserve(points.size());
    for (const auto& point : points) distances.push_back(1000.0 * mesh.closest(point).distance_m);
    std::ranges::sort(distances);
    return distances;
}

/// Of sorted values.
double share_within(const std::vector<double>& sorted, double limit) {
    const auto above = std::ranges::upper_bound(sorted, limit);
    return static_cast<double>(above - sorted.begin()) / static_cast<double>(sorted.size());
}

double percentile(const std::vector<double>& sorted, double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

double rounded(double value) { return std::round(value * 10'000.0) / 10'000.0; }

}  // namespace

std::vector<Eigen::Vector3f> sample_surface(const SurfaceMesh& mesh, std::size_t count) {
    std::vector<double> area_before(1, 0.0);
    for (const auto& t : mesh.triangles) {
        const Eigen::Vector3f &a = mesh.vertices_g_m[t[0]], &b = mesh.vertices_g_m[t[1]],
                              &c = mesh.vertices_g_m[t[2]];
        area_before.push_back(area_before.back() + static_cast<double>((b - a).cross(c - a).norm()));
    }
    std::vector<Eigen::Vector3f> points;
    std::size_t triangle = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double at = (static_cast<double>(i) + 0.5) / static_cast<double>(count) * area_before.back();
        while (triangle + 1 < mesh.triangles.size() && area_before[triangle + 1] <= at) ++triangle;
        // The R2 sequence of Roberts: evenly spread without a random number generator.
        const double u = std::fmod(0.7548776662466927 * static_cast<double>(i + 1), 1.0);
        const double v = std::fmod(0.5698402909980532 * static_cast<double>(i + 1), 1.0);
        const auto root = static_cast<float>(std::sqrt(u)), along = static_cast<float>(v);
        const auto& t = mesh.triangles[triangle];
        points.push_back((1.0f - root) * mesh.vertices_g_m[t[0]] +
                         root * (1.0f - along) * mesh.vertices_g_m[t[1]] +
                         root * along * mesh.vertices_g_m[t[2]]);
    }
    return points;
}

SurfaceMesh transformed(const SurfaceMesh& mesh, const Eigen::Isometry3f& T) {
    SurfaceMesh moved = mesh;
    for (auto& vertex : moved.vertices_g_m) vertex = T * vertex;
    for (auto& normal : moved.normals_g) normal = T.linear() * normal;
    return moved;
}

SurfaceScore score_surface(const SurfaceMesh& mesh, const SurfaceMesh& truth, std::size_t samples) {
    const auto off = distances_mm(sample_surface(mesh, samples), DistanceToMesh(truth));
    const auto missed = distances_mm(sample_surface(truth, samples), DistanceToMesh(mesh));
    SurfaceScore score;
    const auto count = static_cast<double>(samples);
    score.mean_mm = std::accumulate(off.begin(), off.end(), 0.0) / count;
    score.rms_mm = std::sqrt(std::inner_product(off.begin(), off.end(), off.begin(), 0.0) / count);
    score.median_mm = percentile(off, 0.5);
    score.percentile_95_mm = percentile(off, 0.95);
    score.share_over_5_mm = 1.0 - share_within(off, 5.0);
    score.share_over_10_mm = 1.0 - share_within(off, 10.0);
    score.share_over_50_mm = 1.0 - share_within(off, 50.0);
    score.completeness_5_mm = share_within(missed, 5.0);
    score.completeness_10_mm = share_within(missed, 10.0);
    score.samples = samples;
    score.triangles = mesh.triangles.size();
    return score;
}

std::string json_of(const SurfaceScore& score) {
    return nlohmann::ordered_json{{"accuracy",
                                   {{"mean_mm", rounded(score.mean_mm)},
                                    {"rms_mm", rounded(score.rms_mm)},
                                    {"median_mm", rounded(score.median_mm)},
                                    {"percentile_95_mm", rounded(score.percentile_95_mm)},
                                    {"share_over_5_mm", rounded(score.share_over_5_mm)},
                                    {"share_over_10_mm", rounded(score.share_over_10_mm)}}},
                                  {"completeness",
                                   {{"share_within_5_mm", rounded(score.completeness_5_mm)},
                                    {"share_within_10_mm", rounded(score.completeness_10_mm)}}},
                                  {"samples", score.samples},
                                  {"triangles", score.triangles}}
        .dump(2);
}

std::string line_of(const SurfaceScore& score) {
    return fmt::format(
        "surface: mean {:.2f} mm, median {:.2f} mm, 95 % below {:.2f} mm, {:.1f} % over 10 mm off; {:.1f} % "
        "of the "
        "truth within 5 mm",
        score.mean_mm, score.median_mm, score.percentile_95_mm, 100.0 * score.share_over_10_mm,
        100.0 * score.completeness_5_mm);
}

}  // namespace touchstone
