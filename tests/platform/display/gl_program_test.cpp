#include "platform/display/gl_program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "platform/display/headless_display.hpp"
#include "platform/system/error.hpp"

namespace touchstone {
namespace {

constexpr ShaderSource good_vertex{"ui/shaders/good.vert",
                                   "#version 310 es\nvoid main() { gl_Position = vec4(0); }\n"};
constexpr ShaderSource good_fragment{"ui/shaders/good.frag",
                                     "#version 310 es\nprecision mediump float;\nout vec4 color;\n"
                                     "void main() { color = vec4(1); }\n"};

std::string message_of(const ShaderSource& vertex, const ShaderSource& fragment) {
    const auto display = make_headless_display({8, 8});
    try {
        const GlProgram program(vertex, fragment);
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), ExitStatus::unavailable);
        return error.what();
    }
    return "";
}

TEST(GlProgram, GoodShadersMakeAProgram) { EXPECT_EQ(message_of(good_vertex, good_fragment), ""); }

TEST(GlProgram, CompileErrorNamesFileAndLine) {
    const ShaderSource broken{"ui/shaders/broken.frag",
                              "#version 310 es\nprecision mediump float;\nout vec4 color;\n"
                              "void main() {\n    color = unknown_name;\n}\n"};
    EXPECT_THAT(message_of(good_vertex, broken), testing::StartsWith("ui/shaders/broken.frag:5: "));
    EXPECT_THAT(message_of(good_vertex, broken), testing::HasSubstr("unknown_name"));
}

TEST(GlProgram, LinkErrorNamesBothFiles) {
    const ShaderSource wants{"ui/shaders/wants.frag",
                             "#version 310 es\nprecision mediump float;\nin vec4 missing;\nout vec4 color;\n"
                             "void main() { color = missing; }\n"};
    EXPECT_THAT(message_of(good_vertex, wants),
                testing::HasSubstr("ui/shaders/good.vert and ui/shaders/wants.frag"));
}

TEST(GlProgram, LogsOfOtherDriversGiveTheLineToo) {
    EXPECT_EQ(first_shader_error("a.frag", "0:12(5): error: no x\n0:13(1): error: no y\n"),
              "a.frag:12: error: no x");
    EXPECT_EQ(first_shader_error("a.frag", "ERROR: 0:12: 'x' : undeclared"), "a.frag:12: 'x' : undeclared");
    EXPECT_EQ(first_shader_error("a.frag", "0(12) : error C1503: no x"), "a.frag:12: error C1503: no x");
    EXPECT_EQ(first_shader_error("a.frag", "out of memory\nmore"), "a.frag: out of memory");
}

}  // namespace
}  // namespace touchstone
