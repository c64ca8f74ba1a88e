// A still camera stays, slow movement adds up until it stands out, fast movement is followed at once.
#include "pipeline/step_filter.hpp"

#include <functional>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

#include "tests/support/oriented_scene.hpp"

namespace touchstone {
namespace {

/// Sums of a picture whose steps have the noise `sigma` (radians, metres) in each of six directions.
class NoisySteps {
  public:
    explicit NoisySteps(const Vector6d& sigma) : sigma_(sigma) {}

    /// The evidence of a frame, as 30 strips give it.
    StepEvidence evidence() {
        AlignmentSums sums;
        sums.A = (sigma_.array().square().inverse()).matrix().asDiagonal();
        for (int strip = 0; strip < strips; ++strip) {
            sums.b_of_strips.push_back(
                noise((sigma_.array().inverse() / std::sqrt(double{strips})).matrix()));
            sums.b += sums.b_of_strips.back();
        }
        return step_evidence(sums, centre_m);
    }
    /// What tracking says where the camera really is at `twist` from the prediction.
    RigidTransform measured(const Vector6d& twist) { return twist_about(twist + noise(sigma_), centre_m); }

    static constexpr int strips = 30;
    const Eigen::Vector3f centre_m{0.1f, -0.2f, 1.5f};

  private:
    Vector6d noise(const Vector6d& sigma) {
        Vector6d values;
        for (int i = 0; i < 6; ++i) values[i] = sigma[i] * gauss_(random_);
        return values;
    }

    Vector6d sigma_;
    std::mt19937 random_{3};
    std::normal_distribution<double> gauss_;
};

/// 0.05 mm and 0.003 degrees; three times as much along x, which the scene tells least.
Vector6d usual_sigma() { return (Vector6d() << 5e-5, 5e-5, 5e-5, 1.5e-4, 5e-5, 5e-5).finished(); }

Vector6d along_x_m(double x_m) { return (Vector6d() << 0.0, 0.0, 0.0, x_m, 0.0, 0.0).finished(); }

/// Where a camera is believed to be whose true place along x is `place_m(frame)`, in metres; each frame's
/// prediction is of the place believed last. Gives the errors of the frames.
std::vector<double> errors_m(const std::function<double(int)>& place_m, int frames) {
    NoisySteps steps(usual_sigma());
    StepFilter filter({});
    std::vector<double> errors;
    Vector6d believed = Vector6d::Zero();
    for (int frame = 0; frame < frames; ++frame) {
        const RigidTransform step = steps.measured(along_x_m(place_m(frame)) - believed);
        believed += twist_of(filter.believed(step, steps.evidence()), steps.centre_m);
        errors.push_back((believed - along_x_m(place_m(frame))).tail<3>().norm());
    }
    return errors;
}

TEST(StepFilter, AStillCameraStays) {
    const auto errors = errors_m([](int) { return 0.0; }, 1000);
    EXPECT_LT(*std::ranges::max_element(errors), 1e-4);
}

/// A tenth of sigma a frame: it is never farther behind than 6 sigma, and on average 3.
TEST(StepFilter, SlowMovementAddsUpAndIsFollowed) {
    const auto errors = errors_m([](int frame) { return 1.5e-5 * frame; }, 1000);
    EXPECT_LT(*std::ranges::max_element(errors), 9e-4);
    EXPECT_LT(std::accumulate(errors.begin(), errors.end(), 0.0) / 1000.0, 4.5e-4);
}

/// 5 mm a frame after a rest: what noise explains of that is a hundredth of a millimetre.
TEST(StepFilter, FastMovementIsFollowedAtOnce) {
    const auto errors = errors_m([](int frame) { return 5e-3 * std::max(0, frame - 50); }, 100);
    EXPECT_LT(*std::ranges::max_element(errors), 7e-4);
}

/// A jump of 1 mm, 7 sigma: no later than after a second it is believed to half a sigma of the noise.
TEST(StepFilter, ASmallJumpIsBelieved) {
    const auto errors = errors_m([](int frame) { return frame < 50 ? 0.0 : 1e-3; }, 120);
    EXPECT_GT(errors[50], 0.0);
    for (std::size_t frame = 80; frame < 120; ++frame) EXPECT_LT(errors[frame], 7e-4) << frame;
}

/// Without noise every step is a movement; without sums nothing is known, and the camera stays.
TEST(StepFilter, ExactStepsAreBelievedAndUnknownOnesAreNot) {
    NoisySteps exact(Vector6d::Constant(1e-12));
    const RigidTransform step = twist_about(along_x_m(1e-5), exact.centre_m);
    EXPECT_TRUE(StepFilter({}).believed(step, exact.evidence()).isApprox(step, 1e-7f));
    EXPECT_TRUE(StepFilter({}).believed(step, {}).isApprox(RigidTransform::Identity(), 0.0f));
}

/// Neighbouring pixels share their noise. Strips tell how much: rows that are all counted four times look
/// four times as certain, and are not.
TEST(StepFilter, EvidenceIsOfStripsAndNotOfPixels) {
    NoisySteps steps(usual_sigma());
    Vector6d variance = Vector6d::Zero(), of_copies = Vector6d::Zero();
    for (int frame = 0; frame < 200; ++frame) {
        StepEvidence evidence = steps.evidence();
        const auto add = [](const StepEvidence& e, Vector6d& sum) {
            const Matrix6d inverse = e.A.inverse();
            sum += (inverse * e.scatter * inverse).diagonal() / 200.0;
        };
        add(evidence, variance);
        evidence.A *= 4.0;         // each row four times ...
        evidence.scatter *= 16.0;  // ... with the same residual
        add(evidence, of_copies);
    }
    for (int i = 0; i < 6; ++i) {
        EXPECT_NEAR(std::sqrt(variance[i]) / usual_sigma()[i], 1.0, 0.1) << i;
        EXPECT_NEAR(of_copies[i] / variance[i], 1.0, 1e-9) << i;
    }
}

}  // namespace
}  // namespace touchstone
