#include <Eigen/Eigenvalues>
#include <algorithm>

#include "tests/accuracy/distance_to_mesh.hpp"
#include "tests/accuracy/surface_score.hpp"

namespace touchstone {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

struct Pair {
    Eigen::Vector3f place_m;  ///< of the mesh's point, in the frame of the truth
    ClosestPoint found;
};

std::vector<Pair> pairs_of(const std::vector<Eigen::Vector3f>& points, const DistanceToMesh& truth,
                           const Eigen::Isometry3f& T) {
    std::vector<Pair> pairs;
    pairs.reserve(points.size());
    for (const auto& point : points) pairs.push_back({T * point, truth.closest(T * point)});
    return pairs;
}

/// Three times the median distance, at least a millimetre.
double outlier_limit_m(const std::vector<Pair>& pairs) {
    std::vector<double> distances;
    distances.reserve(pairs.size());
    for (const Pair& pair : pairs) distances.push_back(pair.found.distance_m);
    const auto half = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), half, distances.end());
    return std::max(3.0 * *half, 0.001);
}

/// Twist (rotation about the points' middle times `radius_m`, then translation), metres, that lowers the
/// distances along the normals.
Vector6d solve(const std::vector<Pair>& pairs, const Eigen::Vector3f& middle_m, float radius_m) {
    const double limit_m = outlier_limit_m(pairs);
    Matrix6d A = Matrix6d::Zero();
    Vector6d b = Vector6d::Zero();
    for (const Pair& pair : pairs) {
        if (pair.found.distance_m > limit_m) continue;
        const Eigen::Vector3d n = pair.found.normal.cast<double>();
        Vector6d row;
        row << ((pair.place_m - middle_m) / radius_m).cast<double>().cross(n), n;
        A += row * row.transpose();
        b += row * (pair.found.point_m - pair.place_m).cast<double>().dot(n);
    }
    // Directions that the shape leaves open have eigenvalues near 0: no step there.
    const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(A);
    Vector6d step = Vector6d::Zero();
    for (int i = 0; i < 6; ++i) {
        if (eigen.eigenvalues()[i] < 1e-4 * eigen.eigenvalues()[5]) continue;
        step += eigen.eigenvectors().col(i) * eigen.eigenvectors().col(i).dot(b) / eigen.eigenvalues()[i];
    }
    return step;
}

}  // namespace

Eigen::Isometry3f align_to_truth(const SurfaceMesh& mesh, const SurfaceMesh& truth,
                                 const Eigen::Isometry3f& T_truth_mesh) {
    const std::vector<Eigen::Vector3f> points = sample_surface(mesh, 20'000);
    const DistanceToMesh distance(truth);
    Eigen::Isometry3f T = T_truth_mesh;
    for (int iteration = 0; iteration < 100; ++iteration) {
        const std::vector<Pair> pairs = pairs_of(points, distance, T);
        Eigen::Vector3f middle_m = Eigen::Vector3f::Zero();
        for (const Pair& pair : pairs) middle_m += pair.place_m / static_cast<float>(pairs.size());
        float radius_m = 0.0f;
        for (const Pair& pair : pairs) radius_m = std::max(radius_m, (pair.place_m - middle_m).norm());
        const Vector6d step = solve(pairs, middle_m, radius_m);
        const Eigen::Vector3f turn = step.head<3>().cast<float>() / radius_m,
                              shift = step.tail<3>().cast<float>();
        Eigen::Isometry3f move = Eigen::Isometry3f::Identity();
        move.translate(middle_m + shift);
        if (turn.norm() > 0.0f) move.rotate(Eigen::AngleAxisf(turn.norm(), turn.normalized()));
        move.translate(-middle_m);
        T = move * T;
        if (turn.norm() < 1e-6f && shift.norm() < 1e-6f) break;
    }
    return T;
}

}  // namespace touchstone
