// Eq 1 solved: exact rows give the exact twist in the directions that they constrain, and nothing in others.
#include "pipeline/pose_solver.hpp"

#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <vector>

namespace touchstone {
namespace {

constexpr double lever_m = 0.5, min_eigenvalue = 0.002;

/// A point of a surface, from the centre of the twist, and its normal.
struct Sample {
    Eigen::Vector3d p, n;
};

AlignmentSums sums_of(const std::vector<Sample>& samples, const Vector6d& twist, double weight = 1.0) {
    AlignmentSums sums;
    for (const Sample& sample : samples) {
        Vector6d j;
        j << sample.p.cross(sample.n), sample.n;
        sums.A += weight * j * j.transpose();
        sums.b += weight * j * j.dot(twist);
        sums.weight += weight;
        sums.pairs += 1.0;
    }
    return sums;
}

/// Points of a plane through p0 with the normal n, up to half a metre around.
std::vector<Sample> plane_samples(const Eigen::Vector3d& p0, const Eigen::Vector3d& n, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> side_m(-0.5, 0.5);
    const Eigen::Vector3d unit = n.normalized(), u = unit.unitOrthogonal(), v = unit.cross(u);
    std::vector<Sample> samples;
    for (int i = 0; i < 400; ++i) samples.push_back({p0 + side_m(random) * u + side_m(random) * v, unit});
    return samples;
}

std::vector<Sample> joined(std::vector<Sample> a, const std::vector<Sample>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

std::vector<Sample> cylinder_samples(const Eigen::Vector3d& axis) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> along_m(-0.5, 0.5), angle(-1.2, 1.2);
    const Eigen::Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
    std::vector<Sample> samples;
    for (int i = 0; i < 400; ++i) {
        const double phi = angle(random);
        const Eigen::Vector3d n = std::cos(phi) * u + std::sin(phi) * v;
        samples.push_back({0.3 * n + along_m(random) * axis, n});
    }
    return samples;
}

std::vector<Sample> corner_samples() {
    return joined(plane_samples({0.0, 0.0, 0.5}, {0.0, 0.0, 1.0}, 1),
                  joined(plane_samples({0.0, 0.5, 0.0}, {0.0, 1.0, 0.0}, 2),
                         plane_samples({0.5, 0.0, 0.0}, {1.0, 0.0, 0.0}, 3)));
}

Vector6d some_twist() { return (Vector6d() << 0.02, -0.01, 0.03, 0.015, -0.02, 0.01).finished(); }

TEST(PoseSolver, ACornerHoldsNothingAndGivesTheTwist) {
    for (const double weight : {1.0, 40.0, 0.001}) {
        const TwistSolution solution =
            solve_twist(sums_of(corner_samples(), some_twist(), weight), lever_m, min_eigenvalue);
        EXPECT_EQ(solution.held, 0);
        EXPECT_LT((solution.twist - some_twist()).norm(), 1e-12);
        EXPECT_GT(solution.eigenvalues[0], 0.02);
        EXPECT_TRUE(std::is_sorted(solution.eigenvalues.begin(), solution.eigenvalues.end()));
    }
}

TEST(PoseSolver, AFlatWallHoldsThreeDirectionsAndDoesNotSlide) {
    const auto samples = plane_samples({0.0, 0.0, 0.1}, {0.0, 0.0, 1.0}, 1);
    const TwistSolution solution = solve_twist(sums_of(samples, some_twist()), lever_m, min_eigenvalue);
    EXPECT_EQ(solution.held, 3);
    for (const int free : {2, 3, 4}) EXPECT_NEAR(solution.twist[free], 0.0, 1e-12) << free;  // w_z, t_x, t_y
    for (const int solved : {0, 1, 5}) EXPECT_NEAR(solution.twist[solved], some_twist()[solved], 1e-12);
}

/// The wall looks any way: no movement along it, and none turns about its normal.
TEST(PoseSolver, ASlantedWallDoesNotSlideEither) {
    const Eigen::Vector3d n = Eigen::Vector3d(0.3, -0.4, 1.0).normalized();
    const auto samples = plane_samples(Eigen::Vector3d::Zero(), n, 1);
    const TwistSolution solution = solve_twist(sums_of(samples, some_twist()), lever_m, min_eigenvalue);
    EXPECT_EQ(solution.held, 3);
    const Eigen::Vector3d omega = solution.twist.head<3>(), t = solution.twist.tail<3>();
    EXPECT_LT((t - n.dot(some_twist().tail<3>()) * n).norm(), 1e-12);
    EXPECT_LT((omega - (some_twist().head<3>() - n.dot(some_twist().head<3>()) * n)).norm(), 1e-12);
}

TEST(PoseSolver, ACylinderHoldsTwoDirectionsAndAnEdgeOne) {
    const Eigen::Vector3d axis = Eigen::Vector3d::UnitY();
    const TwistSolution cylinder =
        solve_twist(sums_of(cylinder_samples(axis), some_twist()), lever_m, min_eigenvalue);
    EXPECT_EQ(cylinder.held, 2);  // along and about its axis
    EXPECT_NEAR(cylinder.twist[1], 0.0, 1e-12);
    EXPECT_NEAR(cylinder.twist[4], 0.0, 1e-12);
    for (const int solved : {0, 2, 3, 5}) EXPECT_NEAR(cylinder.twist[solved], some_twist()[solved], 1e-12);

    const auto edge_samples = joined(plane_samples(Eigen::Vector3d::Zero(), {0.0, 0.0, 1.0}, 1),
                                     plane_samples(Eigen::Vector3d::Zero(), {0.0, 1.0, 0.0}, 2));
    const TwistSolution edge = solve_twist(sums_of(edge_samples, some_twist()), lever_m, min_eigenvalue);
    EXPECT_EQ(edge.held, 1);  // along x
    for (const int solved : {0, 1, 2, 4, 5}) EXPECT_NEAR(edge.twist[solved], some_twist()[solved], 1e-12);
    EXPECT_NEAR(edge.twist[3], 0.0, 1e-12);
}

TEST(PoseSolver, NothingMovesNothing) {
    const TwistSolution solution = solve_twist({}, lever_m, min_eigenvalue);
    EXPECT_EQ(solution.held, 6);
    EXPECT_TRUE(solution.twist.isZero(0.0));
    const TwistSolution one =
        solve_twist(sums_of({{{0.1, 0.2, 0.0}, {0.0, 0.0, 1.0}}}, some_twist()), lever_m, min_eigenvalue);
    EXPECT_EQ(one.held, 5);
    EXPECT_TRUE(one.twist.allFinite());
}

/// Rotations and translations have one unit: a scene, lever and translation twice as large have the same
/// eigenvalues.
TEST(PoseSolver, EigenvaluesDoNotDependOnTheUnitOfLength) {
    auto samples = corner_samples();
    const TwistSolution metres = solve_twist(sums_of(samples, some_twist()), lever_m, min_eigenvalue);
    for (Sample& sample : samples) sample.p *= 1000.0;
    const TwistSolution millimetres =
        solve_twist(sums_of(samples, some_twist()), 1000.0 * lever_m, min_eigenvalue);
    EXPECT_LT((metres.eigenvalues - millimetres.eigenvalues).norm(), 1e-9);
}

TEST(PoseSolver, ATwistTurnsAboutItsCentre) {
    const Eigen::Vector3f centre(0.1f, -0.2f, 1.0f), t(0.01f, 0.02f, -0.03f);
    Vector6d twist;
    twist << 0.0, 0.0, 0.5 * std::numbers::pi, t.cast<double>();
    const RigidTransform T = twist_about(twist, centre);
    EXPECT_LT((T * centre - (centre + t)).norm(), 1e-6f);
    const Eigen::Vector3f beside = centre + Eigen::Vector3f::UnitX();
    EXPECT_LT((T * beside - (centre + t + Eigen::Vector3f::UnitY())).norm(), 1e-6f);
    EXPECT_TRUE(twist_about(Vector6d::Zero(), centre).isApprox(RigidTransform::Identity(), 0.0f));
    // Small twists are their rows: p + w x (p - c) + t.
    const Eigen::Vector3f p(0.3f, 0.4f, 0.8f);
    const Vector6d small = 0.01 * some_twist();
    const Eigen::Vector3f expected =
        p + small.head<3>().cast<float>().cross(p - centre) + small.tail<3>().cast<float>();
    EXPECT_LT((twist_about(small, centre) * p - expected).norm(), 1e-6f);
}

TEST(PoseSolver, TheTwistOfATransformIsTheOneItWasMadeOf) {
    const Eigen::Vector3f centre(0.1f, -0.2f, 1.0f);
    for (const double scale : {1.0, -0.5, 0.01}) {
        const Vector6d twist = scale * some_twist();
        EXPECT_LT((twist_of(twist_about(twist, centre), centre) - twist).norm(), 1e-6);
    }
    EXPECT_TRUE(twist_of(RigidTransform::Identity(), centre).isZero(0.0));
}

TEST(PoseSolver, ManyProductsStayRotations) {
    RigidTransform T = RigidTransform::Identity();
    const RigidTransform step = twist_about(0.5 * some_twist(), Eigen::Vector3f::Zero());
    for (int i = 0; i < 10000; ++i) T = orthonormal(step * T);
    EXPECT_LT((T.linear() * T.linear().transpose() - Eigen::Matrix3f::Identity()).norm(), 1e-6f);
    EXPECT_NEAR(T.linear().determinant(), 1.0f, 1e-6f);
    const RigidTransform once = orthonormal(T);
    EXPECT_EQ(once.translation(), T.translation());
    EXPECT_LT((once.linear() - T.linear()).norm(), 1e-6f);
}

}  // namespace
}  // namespace touchstone
