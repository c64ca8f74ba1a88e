#include "platform/opencl/program.hpp"

#include <fstream>

#include "tests/support/expect_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

constexpr std::string_view twice = R"(
__kernel void scale(__global const int* in, __global int* out, const int by) {
    out[get_global_id(0)] = by * in[get_global_id(0)];
}
)";

std::vector<int> run_scale(const Device& device, const Program& program) {
    const Buffer<int> in(device, std::vector<int>{1, 2, 3, 4});
    Buffer<int> out(device, 4);
    program.kernel("scale").launch({{4, 1, 1}, {2, 1, 1}}, in, out, 3);
    return out.read();
}

TEST(Program, RunsAKernelWithTypedArguments) {
    const Device device(DeviceConfig{});
    const std::array sources{ProgramSource{"kernels/scale.cl", twice}};
    const Program program(device, sources);
    EXPECT_FALSE(program.came_from_cache());
    EXPECT_EQ(run_scale(device, program), (std::vector<int>{3, 6, 9, 12}));
}

TEST(Program, SecondTimeComesFromTheCache) {
    const TemporaryFolder folder;
    const Device device(DeviceConfig{.choice = "auto", .cache_dir = folder.path()});
    const std::array sources{ProgramSource{"kernels/scale.cl", twice}};
    EXPECT_FALSE(Program(device, sources).came_from_cache());
    const Program second(device, sources);
    EXPECT_TRUE(second.came_from_cache());
    EXPECT_EQ(run_scale(device, second), (std::vector<int>{3, 6, 9, 12}));
    EXPECT_FALSE(Program(device, sources, "-DOTHER").came_from_cache())
        << "other options are another program";
}

TEST(Program, DamagedCacheIsCompiledAgain) {
    const TemporaryFolder folder;
    const Device device(DeviceConfig{.choice = "auto", .cache_dir = folder.path()});
    const std::array sources{ProgramSource{"kernels/scale.cl", twice}};
    (void)Program(device, sources);
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        std::ofstream(entry.path(), std::ios::trunc) << "not a program";
    }
    const Program again(device, sources);
    EXPECT_FALSE(again.came_from_cache());
    EXPECT_EQ(run_scale(device, again), (std::vector<int>{3, 6, 9, 12}));
}

TEST(Program, UnwritableCacheIsNoFailure) {
    const Device device(DeviceConfig{.choice = "auto", .cache_dir = "/proc/nowhere"});
    const std::array sources{ProgramSource{"kernels/scale.cl", twice}};
    EXPECT_EQ(run_scale(device, Program(device, sources)), (std::vector<int>{3, 6, 9, 12}));
}

TEST(Program, BuildErrorNamesFileAndLine) {
    const Device device(DeviceConfig{});
    const std::array sources{
        ProgramSource{"kernels/good.h", "\n\n"},
        ProgramSource{"kernels/broken.cl", "\n__kernel void f() { no_such_thing(); }\n"}};
    expect_error(
        [&] { (void)Program(device, sources); }, ExitStatus::unavailable,
        testing::AllOf(testing::HasSubstr("kernels/broken.cl:2"), testing::HasSubstr("no_such_thing")));
}

TEST(Program, BuildErrorIsLocatedWhereTheDriverCountsJoinedLines) {
    const std::array sources{ProgramSource{"kernels/good.h", "\n\n"},
                             ProgramSource{"kernels/broken.cl", "\n__kernel void f() { g(); }\n"}};
    const auto located = [&](const std::string& log) { return first_build_error(log, sources); };
    // What NVIDIA's driver 580 says of these two, lines as in the joined text.
    EXPECT_EQ(located("\n<kernel>:7:21: error: no g\n1 error\n"), "kernels/broken.cl:2:21: error: no g");
    EXPECT_EQ(located("<kernel>:2:1: error: x"), "kernels/good.h:1:1: error: x");
    EXPECT_EQ(located("<kernel>:99:1: error: beyond"), "<kernel>:99:1: error: beyond");
    EXPECT_EQ(located("kernels/broken.cl:2:21: error: no g"), "kernels/broken.cl:2:21: error: no g");
    EXPECT_EQ(located("out of memory"), "out of memory");
}

TEST(Program, UnknownKernelAndWrongArgumentsAreNamed) {
    const Device device(DeviceConfig{});
    const std::array sources{ProgramSource{"kernels/scale.cl", twice}};
    const Program program(device, sources);
    expect_error([&] { (void)program.kernel("shrink"); }, ExitStatus::unavailable,
                 testing::HasSubstr("kernels/scale.cl:shrink"));
    expect_error([&] { program.kernel("scale").launch({}, 1.0f); }, ExitStatus::unavailable,
                 testing::HasSubstr("kernels/scale.cl:scale"));
}

TEST(Geometry, RoundsUp) {
    EXPECT_EQ(ceil_div(640, 16), 40u);
    EXPECT_EQ(ceil_div(641, 16), 41u);
    EXPECT_EQ(round_up(470, 16), 480u);
}

}  // namespace
}  // namespace touchstone
