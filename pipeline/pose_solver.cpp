#include "pipeline/pose_solver.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace touchstone {

StepEvidence step_evidence(const AlignmentSums& sums, const Eigen::Vector3f& centre_m) {
    StepEvidence evidence{sums.A, Matrix6d::Zero(), centre_m};
    const auto strips = static_cast<double>(sums.b_of_strips.size());
    if (strips < 2.0) return evidence;
    for (const Vector6d& b : sums.b_of_strips) {
        const Vector6d from_mean = b - sums.b / strips;
        evidence.scatter += strips / (strips - 1.0) * from_mean * from_mean.transpose();
    }
    return evidence;
}

TwistSolution solve_twist(const AlignmentSums& sums, double lever_m, double min_eigenvalue) {
    TwistSolution solution;
    if (sums.weight <= 0.0) {
        solution.held = 6;
        return solution;
    }
    // Rotations as movements of lever_m: x = S y.
    Vector6d scale = Vector6d::Ones();
    scale.head<3>().setConstant(1.0 / lever_m);
    const Matrix6d A = scale.asDiagonal() * sums.A * scale.asDiagonal() / sums.weight;
    const Vector6d b = scale.asDiagonal() * sums.b / sums.weight;
    const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(A);
    solution.eigenvalues = eigen.eigenvalues();
    solution.held = static_cast<int>((solution.eigenvalues.array() < min_eigenvalue).count());
    if (solution.held == 0) {
        solution.twist = scale.asDiagonal() * A.llt().solve(b);
        return solution;
    }
    Vector6d y = Vector6d::Zero();
    for (int i = solution.held; i < 6; ++i) {
        const Vector6d direction = eigen.eigenvectors().col(i);
        y += direction * (direction.dot(b) / solution.eigenvalues[i]);
    }
    solution.twist = scale.asDiagonal() * y;
    return solution;
}

RigidTransform twist_about(const Vector6d& twist, const Eigen::Vector3f& centre) {
    const Eigen::Vector3d omega = twist.head<3>();
    const double angle = omega.norm();
    RigidTransform T = RigidTransform::Identity();
    if (angle > 1e-12) T.linear() = Eigen::AngleAxisd(angle, omega / angle).toRotationMatrix().cast<float>();
    T.translation() = twist.tail<3>().cast<float>() + centre - T.linear() * centre;
    return T;
}

Vector6d twist_of(const RigidTransform& T, const Eigen::Vector3f& centre) {
    const Eigen::AngleAxisd turn(T.linear().cast<double>());
    Vector6d twist;
    twist.head<3>() = turn.angle() * turn.axis();
    twist.tail<3>() = (T * centre - centre).cast<double>();
    return twist;
}

RigidTransform orthonormal(const RigidTransform& T) {
    RigidTransform result = T;
    result.linear() = Eigen::Quaternionf(T.linear()).normalized().toRotationMatrix();
    return result;
}

}  // namespace touchstone
