#include "pipeline/projector_fit.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "tests/support/lit_point.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr int width_px = 1280, height_px = 800;

/// A table 1 m wide, 0.75 m deep, a metre under the depth camera.
InteractiveArea table_area() {
    InteractiveArea area;
    area.origin_c_m = {-0.5f, -0.375f, 1.0f};
    area.axis_u_c_m = {1.0f, 0.0f, 0.0f};
    area.axis_v_c_m = {0.0f, 0.75f, 0.0f};
    return area;
}

/// 1.3 m above the table and a little aside, its lens shifted so that the picture lies above its axis.
ProjectorModel true_projector() {
    ProjectorModel model;
    model.width_px = width_px;
    model.height_px = height_px;
    model.focal_px = {1500.0f, 1500.0f};
    model.center_px = {655.0f, 780.0f};
    model.distortion = {0.03f, -0.01f, 0.0005f, -0.0003f};
    model.T_p_g.linear() =
        (Eigen::AngleAxisf(0.06f, Vector3f::UnitX()) * Eigen::AngleAxisf(-0.09f, Vector3f::UnitY()) *
         Eigen::AngleAxisf(0.03f, Vector3f::UnitZ()))
            .toRotationMatrix();
    model.T_p_g.translation() = model.T_p_g.linear() * Vector3f(-0.1f, -0.35f, 0.3f);
    return model;
}

/// Height over the table's plane, towards the camera.
float flat(float, float) { return 0.0f; }
float ridge(float x, float) { return 0.05f * std::exp(-x * x / 0.02f); }
float bowl(float x, float y) { return 0.3f * (x * x + y * y); }

struct Case {
    float sigma_px = 0.0f, sigma_mm = 0.0f;
    float wrong = 0.0f;  ///< share of matches with any pixel
    int across = 40, down = 30;
};

std::vector<ProjectorMatch> matches_of(const ProjectorModel& model, float (*height_m)(float, float),
                                       const Case& c) {
    std::mt19937 random(7);
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> uniform;
    std::vector<ProjectorMatch> matches;
    for (int i = 0; i < c.down; ++i) {
        for (int j = 0; j < c.across; ++j) {
            const float x = -0.45f + 0.9f * static_cast<float>(j) / static_cast<float>(c.across - 1);
            const float y = -0.32f + 0.64f * static_cast<float>(i) / static_cast<float>(c.down - 1);
            const Vector3f point(x, y, 1.0f - height_m(x, y));
            const auto pixel = project(model, point);
            if (!pixel) continue;
            const Vector3f seen =
                point + 0.001f * c.sigma_mm * Vector3f(normal(random), normal(random), normal(random));
            Vector2f at = *pixel + c.sigma_px * Vector2f(normal(random), normal(random));
            if (uniform(random) < c.wrong) at = {width_px * uniform(random), height_px * uniform(random)};
            matches.push_back({seen, at});
        }
    }
    return matches;
}

/// Largest distance on the table, in millimetres, between where the fit and the truth light their places.
float worst_mm(const ProjectorModel& fit, const ProjectorModel& truth, float (*height_m)(float, float)) {
    float worst = 0.0f;
    for (float x = -0.45f; x <= 0.45f; x += 0.05f) {
        for (float y = -0.32f; y <= 0.32f; y += 0.05f) {
            const Vector3f point(x, y, 1.0f - height_m(x, y));
            const auto at = project(fit, point), wanted = project(truth, point);
            if (!at || !wanted) return INFINITY;
            // 1500 pixels a metre of width at 1.3 m.
            worst = std::max(worst, (*at - *wanted).norm() * 1.3f / 1.5f);
        }
    }
    return worst;
}

TEST(ProjectorModel, LightsThePointThatIsProjectedThere) {
    const ProjectorModel model = true_projector();
    for (const Vector3f& point : {Vector3f(0.3f, 0.2f, 1.0f), Vector3f(-0.4f, -0.3f, 1.0f)}) {
        const auto pixel = project(model, point);
        ASSERT_TRUE(pixel);
        const auto lit = test::lit_point_g_m(model, *pixel, table_area());
        ASSERT_TRUE(lit);
        EXPECT_LT((*lit - point).norm(), 1e-4f);
    }
    EXPECT_FALSE(project(model, {0.0f, 0.0f, -1.0f})) << "behind it";
}

/// Brown's model would bring back what lies far outside: r (1 - 0.3 r^2) is largest at r = 1.054.
TEST(ProjectorModel, NothingIsBroughtBackBeyondTheEdgeOfItsLens) {
    ProjectorModel model = true_projector();
    model.distortion = {-0.3f, 0.0f, 0.0f, 0.0f};
    model.T_p_g = RigidTransform::Identity();
    EXPECT_NEAR(lens_edge(model.distortion), 1.0541f, 1e-3f);
    EXPECT_TRUE(project(model, {1.0f, 0.0f, 1.0f}));
    EXPECT_FALSE(project(model, {1.1f, 0.0f, 1.0f}));
    EXPECT_GT(lens_edge({0.03f, 0.0f, 0.0f, 0.0f}), 1e6f) << "one that bends outwards has none";
}

TEST(ProjectorFit, ExactMatchesOnARidgeGiveTheProjector) {
    const ProjectorFit fit =
        fit_projector(matches_of(true_projector(), ridge, {}), width_px, height_px, table_area());
    EXPECT_EQ(fit.verdict, ProjectorVerdict::good) << describe(fit);
    EXPECT_EQ(fit.model.kind, ProjectorModelKind::pinhole);
    EXPECT_LT(fit.rms_px, 0.1f);
    EXPECT_LT(worst_mm(fit.model, true_projector(), ridge), 0.5f);
}

/// A pixel and a millimetre of noise each way, and a fifth of 1200 matches anywhere.
TEST(ProjectorFit, NoiseAndWrongMatchesDoNotBendIt) {
    for (float (*surface)(float, float) : {ridge, bowl}) {
        const auto matches =
            matches_of(true_projector(), surface, {.sigma_px = 1.0f, .sigma_mm = 1.0f, .wrong = 0.2f});
        const ProjectorFit fit = fit_projector(matches, width_px, height_px, table_area());
        EXPECT_EQ(fit.verdict, ProjectorVerdict::good) << describe(fit);
        EXPECT_LT(worst_mm(fit.model, true_projector(), surface), 1.5f);
        EXPECT_NEAR(fit.used, 0.8 * fit.matches, 0.05 * fit.matches);
        EXPECT_NEAR(fit.rms_px, 2.1f, 0.4f) << "of the noise: 1 px and 1 mm each way";
    }
}

TEST(ProjectorFit, OnePlaneGivesAHomographyAndSaysSo) {
    const auto matches = matches_of(true_projector(), flat, {.sigma_px = 0.5f, .wrong = 0.2f});
    const ProjectorFit fit = fit_projector(matches, width_px, height_px, table_area());
    EXPECT_EQ(fit.verdict, ProjectorVerdict::good);
    EXPECT_EQ(fit.model.kind, ProjectorModelKind::homography);
    EXPECT_NE(describe(fit).find("plane"), std::string::npos);
    // What a homography cannot say: the lens bends by up to 5 pixels here.
    EXPECT_LT(worst_mm(fit.model, true_projector(), flat), 5.0f);
    ProjectorModel ideal = true_projector();
    ideal.distortion = {};
    const ProjectorFit exact = fit_projector(matches_of(ideal, flat, {}), width_px, height_px, table_area());
    EXPECT_LT(worst_mm(exact.model, ideal, flat), 0.1f);
}

TEST(ProjectorFit, FourTouchesOnAPlaneAreEnough) {
    ProjectorModel ideal = true_projector();
    ideal.distortion = {};
    const auto matches = matches_of(ideal, flat, {.across = 2, .down = 2});
    const ProjectorFit fit = fit_projector(matches, width_px, height_px, table_area());
    EXPECT_EQ(fit.verdict, ProjectorVerdict::good);
    EXPECT_LT(worst_mm(fit.model, ideal, flat), 0.5f);
}

/// Twelve touches on a ridge, each 2 mm off: what lies between them is as good as they are.
TEST(ProjectorFit, ADozenTouchesAtDifferentHeights) {
    const ProjectorFitConfig touches{.sigma_px = 3.0f, .most_rms_px = 8.0f};
    const auto matches = matches_of(true_projector(), ridge, {.sigma_mm = 1.2f, .across = 4, .down = 3});
    const ProjectorFit fit = fit_projector(matches, width_px, height_px, table_area(), touches);
    EXPECT_EQ(fit.verdict, ProjectorVerdict::good) << describe(fit);
    EXPECT_EQ(fit.model.kind, ProjectorModelKind::pinhole);
    EXPECT_LT(worst_mm(fit.model, true_projector(), ridge), 6.0f);
}

TEST(ProjectorFit, AMirrorInTheLightPath) {
    ProjectorModel mirrored = true_projector();
    mirrored.focal_px.x() *= -1.0f;
    const ProjectorFit fit =
        fit_projector(matches_of(mirrored, ridge, {}), width_px, height_px, table_area());
    EXPECT_EQ(fit.verdict, ProjectorVerdict::good);
    EXPECT_LT(fit.model.focal_px.x(), 0.0f);
    EXPECT_LT(worst_mm(fit.model, mirrored, ridge), 0.5f);
}

TEST(ProjectorFit, SaysWhatIsWrong) {
    const auto good = matches_of(true_projector(), ridge, {});
    EXPECT_EQ(fit_projector(std::span(good).first(3), width_px, height_px, table_area()).verdict,
              ProjectorVerdict::too_few);
    EXPECT_EQ(fit_projector(std::span(good).first(8), width_px, height_px, table_area()).verdict,
              ProjectorVerdict::crowded);
    const auto noise = matches_of(true_projector(), ridge, {.wrong = 1.0f});
    const ProjectorFit fit = fit_projector(noise, width_px, height_px, table_area());
    EXPECT_EQ(fit.verdict, ProjectorVerdict::scattered);
    EXPECT_NE(describe(fit).find("moved"), std::string::npos);
}

}  // namespace
}  // namespace touchstone
