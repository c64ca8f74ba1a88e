// The rules of the house, checked on the tree itself; and the checks, checked on a made-up tree.
#include <cstdlib>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/house/house_rules.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::filesystem::path tree = TOUCHSTONE_SOURCE_DIR;

TEST(House, IncludesFollowTheArrows) { EXPECT_THAT(include_direction_breaches(tree), IsEmpty()); }

TEST(House, KernelsKeepToOpenClC12) { EXPECT_THAT(kernel_language_breaches(tree), IsEmpty()); }

TEST(House, NoFileIsTooLongToRead) { EXPECT_THAT(file_length_breaches(tree, 400), IsEmpty()); }

TEST(House, SourcesAreFormatted) {
    if (std::system("command -v clang-format >/dev/null") != 0)
        GTEST_SKIP() << "clang-format is not installed";
    std::string command = "clang-format --dry-run --Werror";
    for (const auto& path :
         source_files(tree, {"app", "platform", "pipeline", "ui", "tests"}, {".cpp", ".hpp"})) {
        command += " '" + path.string() + "'";
    }
    EXPECT_EQ(std::system(command.c_str()), 0) << "run clang-format -i on the files above";
}

/// A tree of made-up files, gone after the test.
class MadeUpTree : public testing::Test {
  protected:
    void write(const std::string& name, const std::string& text) {
        std::filesystem::create_directories((root_ / name).parent_path());
        std::ofstream(root_ / name) << text;
    }
    Breaches include_from(const std::string& file, const std::string& included) {
        write(file, "#pragma once\n#include \"" + included + "\"\n");
        const Breaches breaches = include_direction_breaches(root_);
        std::filesystem::remove(root_ / file);
        return breaches;
    }

    TemporaryFolder temporary_;
    const std::filesystem::path root_ = temporary_.path();
};

TEST_F(MadeUpTree, ArrowsThatPointDownAreFine) {
    EXPECT_THAT(include_from("app/kiosk.cpp", "ui/scene.hpp"), IsEmpty());
    EXPECT_THAT(include_from("app/kiosk.cpp", "platform/camera/depth_camera.hpp"), IsEmpty());
    EXPECT_THAT(include_from("ui/scenes/paint.cpp", "ui/scene.hpp"), IsEmpty());
    EXPECT_THAT(include_from("ui/scene.hpp", "pipeline/types.hpp"), IsEmpty());
    EXPECT_THAT(include_from("pipeline/raycasting.cpp", "platform/opencl/buffer.hpp"), IsEmpty());
    EXPECT_THAT(include_from("pipeline/raycasting.cpp", "kernel_sources.hpp"), IsEmpty());
    EXPECT_THAT(include_from("platform/openni2_drivers/sequence/a.cpp", "platform/image/png_file.hpp"),
                IsEmpty());
    EXPECT_THAT(include_from("platform/usb/a.cpp", "platform/system/error.hpp"), IsEmpty());
    EXPECT_THAT(include_from("kernels/listing_3_raycast.cl", "kernels/shared_types.h"), IsEmpty());
}

TEST_F(MadeUpTree, ArrowsThatPointUpOrAsideAreFound) {
    EXPECT_THAT(
        include_from("platform/system/log.cpp", "app/config.hpp"),
        ElementsAre("platform/system/log.cpp:2: platform/system must not include \"app/config.hpp\""));
    const std::pair<const char*, const char*> upward[] = {{"ui/a.cpp", "app/a.hpp"},
                                                          {"ui/a.cpp", "pipeline/raycasting.hpp"},
                                                          {"ui/a.cpp", "platform/camera/a.hpp"},
                                                          {"pipeline/a.cpp", "ui/a.hpp"},
                                                          {"pipeline/a.cpp", "app/a.hpp"},
                                                          {"pipeline/a.cpp", "platform/camera/a.hpp"},
                                                          {"platform/usb/a.cpp", "pipeline/types.hpp"},
                                                          {"platform/usb/a.cpp", "platform/camera/a.hpp"},
                                                          {"platform/output/a.cpp", "platform/image/a.hpp"},
                                                          {"platform/system/a.cpp", "kernels/shared_types.h"},
                                                          {"platform/usb/a.cpp", "kernels/device_math.h"},
                                                          {"kernels/a.cl", "pipeline/types.hpp"},
                                                          {"app/a.cpp", "tests/support/a.hpp"},
                                                          {"platform/usb/a.cpp", "../system/error.hpp"}};
    for (const auto& [file, included] : upward) {
        EXPECT_THAT(include_from(file, included), testing::SizeIs(1)) << file << " including " << included;
    }
}

TEST_F(MadeUpTree, IncludesFromBesideAreFound) {
    write("ui/scene.hpp", "");
    EXPECT_THAT(include_from("ui/paint.cpp", "scene.hpp"), testing::SizeIs(1))
        << "not written from the top of the tree";
}

TEST_F(MadeUpTree, KernelsBeyondTheCommonDeviceAreFound) {
    const auto breaches = [&](const std::string& text) {
        write("kernels/a.cl", text);
        return kernel_language_breaches(root_);
    };
    EXPECT_THAT(breaches("kernel void a(read_only image2d_t picture) {}"),
                ElementsAre(HasSubstr("image2d_t")));
    EXPECT_THAT(breaches("\n\nfloat a = 1; double4 b;"), ElementsAre(HasSubstr("kernels/a.cl:3: double4")));
    EXPECT_THAT(breaches("half h;"), ElementsAre(HasSubstr("half")));
    EXPECT_THAT(breaches("int i = get_sub_group_id();"), ElementsAre(HasSubstr("sub_group")));
    EXPECT_THAT(breaches("float s = work_group_reduce_add(x);"),
                ElementsAre(HasSubstr("work_group_reduce_add")));
    EXPECT_THAT(breaches("__attribute__((reqd_work_group_size(32, 16, 1)))"), ElementsAre(HasSubstr("512")));
    EXPECT_THAT(breaches("__attribute__((reqd_work_group_size(16, 16, 1)))"), IsEmpty());
    EXPECT_THAT(breaches("/* half\n of it */ float a; // twice the double"), IsEmpty());
    EXPECT_THAT(
        breaches("float a = half_sqrt(b); int image_width; barrier(CLK_LOCAL_MEM_FENCE); atomic_add(p, 1);"),
        IsEmpty());
}

TEST_F(MadeUpTree, FilesThatAreTooLongAreFound) {
    write("ui/a.cpp", "1\n2\n3\n");
    EXPECT_THAT(file_length_breaches(root_, 3), IsEmpty());
    EXPECT_THAT(file_length_breaches(root_, 2), ElementsAre(HasSubstr("ui/a.cpp: 3 lines")));
}

}  // namespace
}  // namespace touchstone
