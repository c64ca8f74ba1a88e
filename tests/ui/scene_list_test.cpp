#include "ui/scene_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "platform/display/headless_display.hpp"
#include "platform/system/error.hpp"

namespace touchstone {
namespace {

TEST(SceneList, UnknownSceneListsTheNames) {
    try {
        make_scene("pianit");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), ExitStatus::usage);
        EXPECT_THAT(error.what(), testing::HasSubstr("\"pianit\""));
        for (const std::string& name : scene_names()) EXPECT_THAT(error.what(), testing::HasSubstr(name));
    }
}

TEST(SceneList, EveryNameMakesASceneThatInvites) {
    const auto display = make_headless_display({8, 8});
    EXPECT_THAT(scene_names(), testing::Contains("paint"));
    for (const std::string& name : scene_names())
        EXPECT_FALSE(make_scene(name)->invitation().empty()) << name;
}

}  // namespace
}  // namespace touchstone
