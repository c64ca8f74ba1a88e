#include "platform/openni2_drivers/simulator/camera_path.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>
#include <numbers>

#include "platform/openni2_drivers/simulator/rasteriser.hpp"
#include "platform/openni2_drivers/simulator/table_view.hpp"

namespace touchstone::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr CameraMotion motions[] = {CameraMotion::sweep, CameraMotion::orbit, CameraMotion::rpy,
                                    CameraMotion::slide};

struct Speed {
    double mean_mm = 0.0, most_mm = 0.0, mean_deg = 0.0, most_deg = 0.0;
};

Speed speed_of(const CameraPath& path, int frames) {
    Speed speed;
    for (int i = 1; i < frames; ++i) {
        const Isometry3d step = path.at(i - 1).inverse() * path.at(i);
        const double mm = 1000.0 * step.translation().norm();
        const double deg = Eigen::AngleAxisd(step.linear()).angle() * 180.0 / std::numbers::pi;
        speed.mean_mm += mm / (frames - 1);
        speed.mean_deg += deg / (frames - 1);
        speed.most_mm = std::max(speed.most_mm, mm);
        speed.most_deg = std::max(speed.most_deg, deg);
    }
    return speed;
}

TEST(CameraPath, StillStays) {
    const CameraPath path(CameraMotion::still, room_viewpoint(), 5);
    EXPECT_TRUE(path.at(777).isApprox(room_viewpoint().T_s_c, 0.0));
}

TEST(CameraPath, AHandSweepsAtItsSpeed) {
    for (const std::uint64_t seed : {1U, 2U, 9U}) {
        const Speed speed = speed_of(CameraPath(CameraMotion::sweep, room_viewpoint(), seed), 500);
        EXPECT_NEAR(speed.mean_mm, 8.0, 1.5);
        EXPECT_NEAR(speed.mean_deg, 0.5, 0.1);
        EXPECT_LT(speed.most_mm, 20.0);
        EXPECT_LT(speed.most_deg, 1.2);
    }
}

TEST(CameraPath, FastTurnsAreUpToFiveDegreesAFrame) {
    const Speed speed = speed_of(CameraPath(CameraMotion::rpy, room_viewpoint(), 1), 500);
    EXPECT_GT(speed.most_deg, 4.0);
    EXPECT_LT(speed.most_deg, 5.5);
    EXPECT_LT(speed.most_mm, 6.0);
}

TEST(CameraPath, AnOrbitLooksAtOnePoint) {
    const Viewpoint start = room_viewpoint();
    const CameraPath path(CameraMotion::orbit, start, 3);
    const Vector3d pivot_c(0.0, 0.0, start.pivot_m);
    const Vector3d pivot_s = start.T_s_c * pivot_c;
    double farthest_m = 0.0;
    for (int i = 0; i < 500; i += 7) {
        EXPECT_NEAR((path.at(i) * pivot_c - pivot_s).norm(), 0.0, 1e-9);
        farthest_m = std::max(farthest_m, (path.at(i).translation() - start.T_s_c.translation()).norm());
    }
    EXPECT_GT(farthest_m, 1.0);
}

TEST(CameraPath, ASlideKeepsItsDistanceFromTheWall) {
    const CameraPath path(CameraMotion::slide, wall_viewpoint(), 1);
    double least_m = 0.0, most_m = 0.0;
    for (int i = 0; i < 400; ++i) {
        const Vector3d eye = path.at(i).translation();
        EXPECT_DOUBLE_EQ(eye.y(), -1.2);
        EXPECT_TRUE(path.at(i).linear().isApprox(wall_viewpoint().T_s_c.linear(), 1e-12));
        least_m = std::min(least_m, eye.x());
        most_m = std::max(most_m, eye.x());
    }
    EXPECT_LT(least_m, -0.4);
    EXPECT_GT(most_m, 0.4);
}

TEST(CameraPath, StartsFromRestAndComesBackAndFollowsTheSeed) {
    for (const CameraMotion motion : motions) {
        const CameraPath path(motion, room_viewpoint(), 4);
        EXPECT_TRUE(path.at(0).isApprox(room_viewpoint().T_s_c, 1e-12));
        EXPECT_LT((path.at(1).translation() - path.at(0).translation()).norm(), 0.003);
        EXPECT_FALSE(path.at(100).isApprox(CameraPath(motion, room_viewpoint(), 5).at(100), 1e-6));
        double nearest_m = 1e9;
        for (int i = 200; i < 500; ++i)
            nearest_m = std::min(nearest_m, (path.at(i).translation() - path.at(60).translation()).norm());
        EXPECT_LT(nearest_m, 0.35) << "of paths that reach over a metre";
    }
}

/// Least eigenvalue of the mean of J J^T, J the row of point-to-plane ICP about the middle of the points,
/// whose rms radius is the unit of length: 0 = a movement that no pixel sees, 1/6 at best.
double least_constraint(const TriangleMesh& mesh, const Raster& raster, const Isometry3d& T_s_c) {
    std::vector<std::pair<Vector3d, Vector3d>> samples;
    Vector3d middle = Vector3d::Zero();
    for (std::size_t i = 0; i < raster.depth_m.size(); i += 61) {
        if (raster.triangle[i] == Raster::no_triangle) continue;
        const Vector3d ray((static_cast<double>(i % 640) - 319.5) / 575.8,
                           (static_cast<double>(i / 640) - 239.5) / 575.8, 1.0);
        const Vector3d p_s = T_s_c * (static_cast<double>(raster.depth_m[i]) * ray);
        samples.emplace_back(
            p_s, triangle_normal(mesh, static_cast<std::size_t>(raster.triangle[i])).cast<double>());
        middle += p_s;
    }
    const auto count = static_cast<double>(samples.size());
    middle /= count;
    double radius2 = 0.0;
    for (const auto& [p_s, n_s] : samples) radius2 += (p_s - middle).squaredNorm() / count;
    Eigen::Matrix<double, 6, 6> sum = Eigen::Matrix<double, 6, 6>::Zero();
    for (const auto& [p_s, n_s] : samples) {
        Eigen::Matrix<double, 6, 1> row;
        row << (p_s - middle).cross(n_s) / std::sqrt(radius2), n_s;
        sum += row * row.transpose() / count;
    }
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>(sum).eigenvalues()[0];
}

TEST(CameraPath, TheRoomIsAlwaysInReachAndHoldsAllSixDirections) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
        const TriangleMesh mesh = make_room(seed);
        for (const CameraMotion motion : motions) {
            const CameraPath path(motion, room_viewpoint(), seed);
            Raster raster;
            for (int frame = 0; frame < 500; frame += 31) {
                const Isometry3d T_s_c = path.at(frame);
                rasterise(mesh, T_s_c.inverse(), kinect_intrinsics(), raster);
                const auto [least, most] = std::minmax_element(raster.depth_m.begin(), raster.depth_m.end());
                EXPECT_GT(*least, 0.55F)
                    << static_cast<int>(motion) << " seed " << seed << " frame " << frame;
                EXPECT_LT(*most, 3.7F) << static_cast<int>(motion) << " seed " << seed << " frame " << frame;
                EXPECT_GT(least_constraint(mesh, raster, T_s_c), 0.01)
                    << static_cast<int>(motion) << " seed " << seed << " frame " << frame;
            }
        }
    }
}

}  // namespace
}  // namespace touchstone::sim
