#include "app/projector_file.hpp"

#include <fstream>
#include <gtest/gtest.h>

#include "app/projector_mapping.hpp"
#include "platform/system/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

SavedProjector pinhole() {
    SavedProjector saved;
    saved.model.width_px = 1280;
    saved.model.height_px = 800;
    saved.model.focal_px = {1500.0f, 1490.0f};
    saved.model.center_px = {655.0f, 780.0f};
    saved.model.distortion = {0.03f, -0.01f, 0.0005f, -0.0003f};
    saved.model.T_p_g.linear() =
        Eigen::AngleAxisf(0.3f, Eigen::Vector3f(1.0f, 2.0f, 0.5f).normalized()).matrix();
    saved.model.T_p_g.translation() = Eigen::Vector3f(0.1f, -0.4f, 0.3f);
    saved.method = "graycode";
    saved.rms_px = 0.4f;
    saved.rms_mm = 0.5f;
    saved.points = 8000;
    return saved;
}

void expect_same_light(const ProjectorModel& a, const ProjectorModel& b) {
    for (const Eigen::Vector3f& point :
         {Eigen::Vector3f(0.1f, 0.2f, 1.0f), Eigen::Vector3f(-0.3f, 0.1f, 1.2f)}) {
        const auto at = project(a, point), wanted = project(b, point);
        ASSERT_TRUE(at && wanted);
        EXPECT_LT((*at - *wanted).norm(), 0.01f);
    }
}

TEST(ProjectorFile, KeepsAPinhole) {
    const TemporaryFolder folder;
    save_projector(folder / "projector", pinhole());
    const SavedProjector read = load_projector(folder / "projector");
    EXPECT_EQ(read.method, "graycode");
    EXPECT_EQ(read.points, 8000);
    EXPECT_EQ(read.rms_mm, 0.5f);
    EXPECT_EQ(read.model.width_px, 1280);
    EXPECT_EQ(read.model.kind, ProjectorModelKind::pinhole);
    expect_same_light(read.model, pinhole().model);
}

TEST(ProjectorFile, KeepsAHomography) {
    const TemporaryFolder folder;
    SavedProjector saved = pinhole();
    saved.model.kind = ProjectorModelKind::homography;
    saved.model.plane_g = {{-0.5f, -0.4f, 1.0f}, {1.0f, 0.1f, 0.0f}, {0.0f, 0.8f, 0.05f}};
    saved.model.H_px_uv << 900.0f, 20.0f, 150.0f, 10.0f, 700.0f, 60.0f, 0.05f, -0.02f, 1.0f;
    save_projector(folder / "projector", saved);
    const SavedProjector read = load_projector(folder / "projector");
    EXPECT_EQ(read.model.kind, ProjectorModelKind::homography);
    expect_same_light(read.model, saved.model);
}

TEST(ProjectorFile, DamageIsSaid) {
    const TemporaryFolder folder;
    EXPECT_THROW(load_projector(folder / "nothing"), Error);
    save_projector(folder / "projector", pinhole());
    std::fstream file(folder / "projector", std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(60);
    file.put('x');
    file.close();
    EXPECT_THROW(load_projector(folder / "projector"), Error);
    SavedProjector without_size = pinhole();
    without_size.model.width_px = 0;
    save_projector(folder / "projector", without_size);
    EXPECT_THROW(load_projector(folder / "projector"), Error);
}

/// What a model says of a point does not depend on the frame in which the point is given.
TEST(ProjectorModel, InAnotherFrameLightsTheSamePoints) {
    RigidTransform T_new_old = RigidTransform::Identity();
    T_new_old.linear() = Eigen::AngleAxisf(0.4f, Eigen::Vector3f::UnitY()).matrix();
    T_new_old.translation() = Eigen::Vector3f(0.5f, 0.2f, -0.1f);
    const Eigen::Vector3f point(0.1f, 0.2f, 1.0f);
    SavedProjector flat = pinhole();
    flat.model.kind = ProjectorModelKind::homography;
    for (const ProjectorModel& model : {pinhole().model, flat.model}) {
        const Eigen::Vector3f elsewhere = T_new_old * point;
        const auto at = project(in_other_frame(model, T_new_old), elsewhere), wanted = project(model, point);
        ASSERT_TRUE(at && wanted);
        EXPECT_LT((*at - *wanted).norm(), 0.01f);
    }
}

}  // namespace
}  // namespace touchstone
