#include "app/areas_file.hpp"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/area_scenes.hpp"
#include "platform/system/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class AreasFile : public testing::Test {
  protected:
    std::vector<NamedArea> read(const std::string& text) const {
        std::ofstream(file_) << text;
        return load_areas(file_);
    }
    /// What is said of a file, and with which status.
    std::string refusal(const std::string& text) const {
        try {
            (void)read(text);
        } catch (const Error& error) {
            EXPECT_EQ(error.status(), ExitStatus::configuration) << text;
            return error.what();
        }
        return "accepted";
    }

    const TemporaryFolder folder_;
    const std::filesystem::path file_ = folder_ / "areas.toml";
};

const std::string square = "corners_mm = [[0, 0], [100, 0], [100, 100], [0, 100]]\n";

TEST_F(AreasFile, WhatIsSavedIsLoaded) {
    const std::vector<NamedArea> areas{
        {"left \"half\"", "paint", "left@table", {{-300.f, -200.f}, {0.f, -200.25f}, {-20.f, 200.f}}},
        {"right", "", "", {{0, 0}, {100, 0}, {100, 100}, {0, 100}}}};
    save_areas(file_, areas);
    const std::vector<NamedArea> loaded = load_areas(file_);
    ASSERT_EQ(loaded.size(), areas.size());
    for (std::size_t i = 0; i < areas.size(); ++i) {
        EXPECT_EQ(loaded[i].name, areas[i].name);
        EXPECT_EQ(loaded[i].scene, areas[i].scene);
        EXPECT_EQ(loaded[i].source, areas[i].source);
        ASSERT_EQ(loaded[i].corners_mm.size(), areas[i].corners_mm.size());
        for (std::size_t k = 0; k < areas[i].corners_mm.size(); ++k)
            EXPECT_LE((loaded[i].corners_mm[k] - areas[i].corners_mm[k]).norm(), 0.08f) << "tenths of mm";
    }
}

TEST_F(AreasFile, NoneIsATableThatIsOne) {
    EXPECT_THAT(read("area = []"), IsEmpty());
    save_areas(file_, {});
    EXPECT_THAT(load_areas(file_), IsEmpty());
}

TEST_F(AreasFile, WhatIsWrongIsNamedWithItsLine) {
    EXPECT_THAT(refusal("[[area]]\nname = \"a\"\nscenes = \"paint\"\n" + square),
                HasSubstr("areas.toml:3: there is no key area.scenes"));
    EXPECT_THAT(refusal("# what is left of a file"), HasSubstr("[[area]], or area = [] for none"));
    EXPECT_THAT(refusal("[area]\nname = \"a\"\n" + square), HasSubstr("list of tables: [[area]]"));
    EXPECT_THAT(refusal("[[areas]]\nname = \"a\"\n" + square), HasSubstr("there is no key areas"));
    EXPECT_THAT(refusal("[[area]]\n" + square), HasSubstr("needs a name"));
    for (const std::string name : {"../up", "two\\nlines", "", "12345678901234567890123456789012345678901"})
        EXPECT_THAT(refusal("[[area]]\nname = \"" + name + "\"\n" + square), HasSubstr("needs a name"))
            << name;
    EXPECT_THAT(refusal("[[area]]\nname = \"a\"\n"), HasSubstr("3 to 12 corners"));
    EXPECT_THAT(refusal("[[area]]\nname = 3\n" + square), HasSubstr("areas.toml:2: this is a text"));
    EXPECT_THAT(refusal("[[area]]\nname = \"a\"\n" + square + "[[area]]\nname = \"a\"\n" + square),
                HasSubstr("areas.toml:4: two areas are called \"a\""));
    for (const char* corners : {"7", "[7]", "[[1, 2, 3]]", "[[1, \"2\"]]", "[[1, nan]]", "[[1, 1e9]]"})
        EXPECT_THAT(refusal(std::string("[[area]]\nname = \"a\"\ncorners_mm = ") + corners + "\n"),
                    HasSubstr("areas.toml:3: "))
            << corners;
    EXPECT_THAT(refusal("[[area]\n"), HasSubstr("areas.toml:1: "));
    EXPECT_EQ(refusal("[[area]]\nname = tru\n").find('\n'), std::string::npos) << "one line";
    std::filesystem::remove(file_);
    try {
        (void)load_areas(file_);
        FAIL() << "there is no file";
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), ExitStatus::no_input);
    }
}

TEST_F(AreasFile, WhereItIsWrongTheOneBeforeItCountsAndIsNotPushedOut) {
    const auto named = [](const std::string& name) {
        return std::vector<NamedArea>{{name, "", "", {{0, 0}, {100, 0}, {100, 100}}}};
    };
    save_areas(file_, named("first"));
    save_areas(file_, named("second"));
    EXPECT_EQ(load_areas(file_).at(0).name, "second");
    std::ofstream(file_) << "[[area]]\nname = 7\n";
    EXPECT_EQ(load_areas(file_).at(0).name, "first");
    save_areas(file_, named("third"));
    std::ofstream(file_) << "[[area]]\nname = 7\n";
    EXPECT_EQ(load_areas(file_).at(0).name, "first");
}

std::string conflict(const std::string& first, const std::string& second, bool on_surface) {
    try {
        check_scenes({{"a", first, "", {}}, {"b", second, "", {}}}, "particles", on_surface);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(AreaScenes, ThoseThatWishForTheSameThingAreNotTogether) {
    EXPECT_EQ(conflict("paint", "paint", true), "");
    EXPECT_EQ(conflict("paint", "particles", true), "");
    EXPECT_EQ(conflict("mirror", "particles", false), "");
    EXPECT_THAT(conflict("particles", "particles", true), HasSubstr("particles can be in one area only"));
    EXPECT_THAT(conflict("", "particles", true), HasSubstr("in one area only")) << "the table's counts";
    EXPECT_THAT(conflict("mirror", "inspect", false), HasSubstr("mirror and inspect cannot"));
    EXPECT_THAT(conflict("mirror", "paint", true), HasSubstr("area a: there is no scene mirror here"));
    EXPECT_THAT(conflict("paint", "pain", false), HasSubstr("area b: there is no scene pain here"));
}

TEST(AreaScenes, AreToldWithTheNamesOfTheirAreas) {
    EXPECT_EQ(told({{"kids", "paint", "", {}}, {"right", "", "", {}}}, "photos"),
              "kids (paint), right (photos)");
}

}  // namespace
}  // namespace touchstone
