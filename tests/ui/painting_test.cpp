#include "ui/painting.hpp"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <unistd.h>

#include "platform/system/error.hpp"
#include "ui/painting_file.hpp"

namespace touchstone {
namespace {

using Eigen::Vector3f;

int draw(Painting& painting, float x_m, int points = 5) {
    const int stroke = painting.begin({10, 20, 30}, 14.f, false, {x_m, 0.f, 1.f});
    for (int i = 1; i < points; ++i) painting.extend(stroke, {x_m, 0.01f * static_cast<float>(i), 1.f});
    painting.finish(stroke);
    return stroke;
}

std::filesystem::path file_of(const char* name) {
    return std::filesystem::temp_directory_path() /
           (std::string("touchstone_") + name + std::to_string(getpid()));
}

TEST(Painting, UndoTakesTheLastFinishedStroke) {
    Painting painting;
    draw(painting, 0.1f);
    draw(painting, 0.2f);
    const int going_on = painting.begin({}, 14.f, false, {0.3f, 0.f, 1.f});
    ASSERT_TRUE(painting.undo());
    ASSERT_EQ(painting.visible().size(), 2U);
    EXPECT_EQ(painting.visible()[0]->points_g_m[0].x(), 0.1f);
    EXPECT_EQ(painting.visible()[1]->points_g_m[0].x(), 0.3f);
    EXPECT_TRUE(painting.extend(going_on, {0.4f, 0.f, 1.f}));
}

TEST(Painting, UndoHasManyLevelsAndEnds) {
    Painting painting;
    for (int i = 0; i < 200; ++i) draw(painting, 0.01f * static_cast<float>(i));
    for (int i = 0; i < 200; ++i) EXPECT_TRUE(painting.undo());
    EXPECT_FALSE(painting.undo());
    EXPECT_TRUE(painting.is_empty());
    EXPECT_EQ(painting.points(), 0U);
}

TEST(Painting, UndoBringsBackWhatWasCleared) {
    Painting painting;
    draw(painting, 0.1f);
    draw(painting, 0.2f);
    painting.clear();
    EXPECT_TRUE(painting.is_empty());
    draw(painting, 0.3f);
    EXPECT_EQ(painting.visible().size(), 1U);
    painting.undo();
    painting.undo();
    EXPECT_EQ(painting.visible().size(), 2U);
}

TEST(Painting, PlacesNearerThanAStepAreOne) {
    Painting painting;
    const int stroke = painting.begin({}, 14.f, false, {0.f, 0.f, 1.f});
    EXPECT_FALSE(painting.extend(stroke, {0.0005f, 0.f, 1.f}));
    EXPECT_TRUE(painting.extend(stroke, {0.002f, 0.f, 1.f}));
    EXPECT_EQ(painting.points(), 2U);
}

TEST(Painting, TheOldestGoesBeyondTheLimits) {
    Painting painting({.points = 100, .deeds = 50});
    for (int i = 0; i < 500; ++i) draw(painting, 0.1f + 0.001f * static_cast<float>(i));
    EXPECT_LE(painting.points(), 100U);
    EXPECT_GE(painting.points(), 80U);
    EXPECT_FLOAT_EQ(painting.visible().back()->points_g_m[0].x(), 0.599f);
}

TEST(Painting, BytesGiveTheSameBack) {
    Painting painting;
    draw(painting, 0.1f);
    painting.clear();
    draw(painting, 0.2f, 9);
    painting.finish(painting.begin({200, 100, 50}, 33.f, true, {1.f, 2.f, 3.f}));
    Painting read = Painting::from_bytes(painting.bytes());
    ASSERT_EQ(read.visible().size(), 2U);
    EXPECT_EQ(read.visible()[0]->points_g_m, painting.visible()[0]->points_g_m);
    EXPECT_EQ(read.visible()[1]->color, painting.visible()[1]->color);
    EXPECT_TRUE(read.visible()[1]->erases);
    EXPECT_EQ(read.bytes(), painting.bytes());
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(read.undo()) << "undo goes on";
    EXPECT_FALSE(read.undo());
}

/// Every cut and every changed byte is either refused or gives finite numbers.
TEST(Painting, DamagedBytesAreRefusedOrHarmless) {
    Painting painting;
    draw(painting, 0.1f);
    painting.clear();
    draw(painting, 0.2f);
    const std::string bytes = painting.bytes();
    for (std::size_t cut = 0; cut < bytes.size(); ++cut)
        EXPECT_THROW(Painting::from_bytes(bytes.substr(0, cut)), Error) << cut;
    EXPECT_THROW(Painting::from_bytes(bytes + '\0'), Error);
    for (std::size_t at = 0; at < bytes.size(); ++at)
        for (const char value : {'\x00', '\x7f', '\xff'}) {
            std::string damaged = bytes;
            damaged[at] = value;
            try {
                const Painting read = Painting::from_bytes(damaged);
                for (const Stroke* stroke : read.visible())
                    for (const Vector3f& point : stroke->points_g_m) EXPECT_TRUE(point.allFinite());
            } catch (const Error& error) {
                EXPECT_EQ(error.status(), ExitStatus::bad_data);
            }
        }
}

TEST(PaintingFile, KeepsPaintingAndPose) {
    const auto file = file_of("kept");
    Painting painting;
    draw(painting, 0.1f);
    RigidTransform T_g_c = RigidTransform::Identity();
    T_g_c.translate(Vector3f(0.1f, 0.2f, 0.3f)).rotate(Eigen::AngleAxisf(0.4f, Vector3f::UnitX()));
    save_painting(file, painting, T_g_c);
    const auto stored = load_painting(file);
    std::filesystem::remove(file);
    ASSERT_TRUE(stored);
    EXPECT_EQ(stored->painting.bytes(), painting.bytes());
    EXPECT_EQ(stored->T_g_c.matrix(), T_g_c.matrix());
}

TEST(PaintingFile, NoneWhereThereIsNoFile) { EXPECT_FALSE(load_painting(file_of("missing"))); }

TEST(PaintingFile, EveryDamageIsNoticed) {
    const auto file = file_of("damaged");
    Painting painting;
    draw(painting, 0.1f);
    save_painting(file, painting, RigidTransform::Identity());
    std::ifstream input(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(input), {}};
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
        std::ofstream(file, std::ios::binary) << damaged;
        EXPECT_THROW(load_painting(file), Error) << at;
    }
    std::ofstream(file, std::ios::binary) << bytes.substr(0, bytes.size() / 2);
    EXPECT_THROW(load_painting(file), Error);
    std::filesystem::remove(file);
}

}  // namespace
}  // namespace touchstone
