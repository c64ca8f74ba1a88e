#include "app/config.hpp"

#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>

#include "app/config_paths.hpp"
#include "tests/support/expect_error.hpp"

namespace touchstone {
namespace {

using testing::AllOf;
using testing::HasSubstr;

void expect_refused(const std::string& text, const testing::Matcher<std::string>& message) {
    expect_error(
        [&] {
            Config config;
            parse_config(text, "table.toml", config);
        },
        ExitStatus::configuration, message);
}

TEST(Config, ValuesAreTakenOver) {
    Config config;
    parse_config("[scan]\nframes = 12\n[tuio]\nhost = \"10.0.0.7\"\nenabled = false\n[volume]\nside_m = 2\n",
                 "table.toml", config);
    EXPECT_EQ(config.interaction.scan_frames, 12);
    EXPECT_EQ(config.tuio.host, "10.0.0.7");
    EXPECT_FALSE(config.tuio.enabled);
    EXPECT_FLOAT_EQ(config.interaction.background.volume.side_m, 2.0f);
}

TEST(Config, OnlyTuioOverUdpIsOnUnasked) {
    Config config;
    EXPECT_TRUE(config.tuio.enabled);
    EXPECT_EQ(config.tuio.hover_port, 0);
    EXPECT_FALSE(config.web_socket_enabled);
    EXPECT_EQ(config.web_socket.host, "127.0.0.1");
    EXPECT_FALSE(config.touch_screen_enabled);
    parse_config("[uinput]\nenabled = true\nslots = 5\nwidth_mm = 640\nheight_mm = 480\n", "table.toml",
                 config);
    EXPECT_TRUE(config.touch_screen_enabled);
    EXPECT_EQ(config.touch_screen.slots, 5);
    EXPECT_EQ(config.touch_screen.width_mm, 640);
    EXPECT_EQ(config.touch_screen.height_mm, 480);
}

TEST(Config, PrintedConfigurationReadsBackTheSame) {
    Config changed;
    changed.interaction.scan_frames = 17;
    changed.interaction.noise.quadratic = 0.00123f;
    changed.tuio.source = "table \"one\"";
    Config read;
    parse_config(print_config(changed), "printed", read);
    EXPECT_EQ(print_config(read), print_config(changed));
    EXPECT_EQ(read.interaction.noise.quadratic, 0.00123f);
    EXPECT_EQ(read.tuio.source, "table \"one\"");
}

/// After a change of a key: touchstone run --print-config > docs/touchstone.toml.
TEST(Config, TheHandbookHasEveryKey) {
    std::ifstream file(std::filesystem::path(TOUCHSTONE_SOURCE_DIR) / "docs/touchstone.toml");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(text, print_config(Config{}));
}

TEST(Config, UnknownKeyIsNamedWithItsLineAndWhatThereIs) {
    expect_refused("[scan]\nframes = 5\nframe = 5\n",
                   AllOf(HasSubstr("table.toml:3"), HasSubstr("scan.frame;"), HasSubstr("frames")));
    expect_refused("[skan]\nframes = 5\n",
                   AllOf(HasSubstr("table.toml:1"), HasSubstr("skan"), HasSubstr("scan")));
    expect_refused("frames = 5\n", HasSubstr("table.toml:1"));
}

TEST(Config, BadValuesAreNamedWithTheAllowedRange) {
    expect_refused("[tuio]\nport = 70000\n",
                   AllOf(HasSubstr("table.toml:2"), HasSubstr("tuio.port"), HasSubstr("1 to 65535")));
    expect_refused("[tuio]\nport = \"x\"\n", HasSubstr("1 to 65535"));
    expect_refused("[tuio]\nport = 3.5\n", HasSubstr("whole number"));
    expect_refused("[tuio]\nenabled = 1\n", HasSubstr("true or false"));
    expect_refused("[volume]\nside_m = nan\n", HasSubstr("volume.side_m"));
    expect_refused("[tuio]\nhost = 5\n", HasSubstr("text in quotes"));
}

TEST(Config, BrokenTomlIsNamedWithItsLine) {
    expect_refused("[scan]\nframes = \n", HasSubstr("table.toml:2"));
}

TEST(Config, ATextWithoutQuotesIsShownWithThem) {
    for (const char* value : {"table.scan", "/var/table.scan", "~/table.scan", "info"})
        expect_refused(fmt::format("[scan]\nfile = {}  # where\n", value),
                       AllOf(HasSubstr("table.toml:2: "),
                             HasSubstr(fmt::format("; a text stands in quotes: file = \"{}\"", value))));
    expect_refused("[scan]\nframes = = 2\n", testing::Not(HasSubstr("quotes")));
    expect_refused("[scan]\nfile\n", testing::Not(HasSubstr("quotes")));
}

TEST(Config, AWordThatIsNoChoiceIsNamedWithThoseThereAre) {
    expect_refused("[display]\nscene = \"photo\"\n",
                   HasSubstr("table.toml:2: display.scene is one of \"paint\", \"particles\", \"mirror\", "
                             "\"photos\", \"inspect\", \"attract\""));
    expect_refused("[log]\nlevel = \"loud\"\n", HasSubstr("log.level is one of \"debug\", \"info\""));
    expect_refused("[foreground]\nreconstruct = \"yes\"\n", HasSubstr("foreground.reconstruct is one of"));
    expect_refused("[rendering]\nview = \"\"\n", HasSubstr("rendering.view is one of"));
}

class PathInConfig : public testing::Test {
  protected:
    void SetUp() override { unsetenv("STATE_DIRECTORY"); }
    void TearDown() override { unsetenv("STATE_DIRECTORY"); }
};

TEST_F(PathInConfig, ARelativeOneLiesBesideTheFile) {
    Config config;
    parse_config(
        "[sensor]\nuri = \"seq:../film\"\n[scan]\nfile = \"table.scan\"\n[display]\nphotos = \"/photos\"\n",
        "/tables/one/table.toml", config);
    EXPECT_EQ(config.scan_file, "/tables/one/table.scan");
    EXPECT_EQ(config.sensor_uri, "seq:/tables/film");
    EXPECT_EQ(config.display.photos, "/photos");
    EXPECT_EQ(config.projector.file, "");
    const auto here = std::filesystem::current_path();
    EXPECT_EQ(path_in_config("table.toml", "a/b"), (here / "a/b").string());
    EXPECT_EQ(path_in_config("in/table.toml", "a"), (here / "in/a").string());
    EXPECT_EQ(sensor_uri_in_config("/x/t.toml", "table.oni"), "/x/table.oni");
    EXPECT_EQ(sensor_uri_in_config("/x/t.toml", "sim:flat?truth=t.json"), "sim:flat?truth=t.json");
    EXPECT_EQ(sensor_uri_in_config("/x/t.toml", ""), "");
}

TEST_F(PathInConfig, OfAServiceLiesWithWhatItKeeps) {
    setenv("STATE_DIRECTORY", "/var/lib/touchstone:/var/lib/other", 1);
    EXPECT_EQ(path_in_config("/etc/touchstone/touchstone.toml", "table.scan"),
              "/var/lib/touchstone/table.scan");
    EXPECT_EQ(path_in_config("/etc/touchstone/touchstone.toml", "/mnt/table.scan"), "/mnt/table.scan");
}

TEST_F(PathInConfig, TheHomeOfTheUser) {
    const std::string home = std::getenv("HOME") != nullptr ? std::getenv("HOME") : "";
    ASSERT_FALSE(home.empty());
    EXPECT_EQ(path_in_config("/x/t.toml", "~/photos"), home + "/photos");
    EXPECT_EQ(path_in_config("/x/t.toml", "~photos"), "/x/~photos");
}

TEST(Config, MissingFileIsNoInput) {
    expect_error(
        [] {
            Config config;
            load_config("/nowhere/table.toml", config);
        },
        ExitStatus::no_input, HasSubstr("/nowhere/table.toml"));
}

TEST(Config, TheModelsNoiseStandsWhereNoneIsSet) {
    Config config;
    SensorModel model;
    model.noise = {0.002f, 0.001f, 0.1f, 0.0f};
    EXPECT_EQ(interaction_config(config, &model).noise.constant_m, 0.002f);
    EXPECT_EQ(interaction_config(config, nullptr).noise.constant_m, config.interaction.noise.constant_m);
    parse_config("[noise]\ngrazing = 0.0002\n", "set", config);
    EXPECT_EQ(interaction_config(config, &model).noise.grazing, 0.0002f);
    EXPECT_EQ(interaction_config(config, &model).noise.constant_m, config.interaction.noise.constant_m);
}

TEST(Config, ASensorModeIsReadOrRefused) {
    Config config;
    EXPECT_FALSE(camera_setup(config).mode);
    config.sensor_mode = "320x240@60";
    EXPECT_EQ(camera_setup(config).mode, (DepthMode{320, 240, 60}));
    config.sensor_mode = "fast";
    expect_error([&] { camera_setup(config); }, ExitStatus::configuration,
                 ::testing::HasSubstr("sensor.mode \"fast\""));
}

}  // namespace
}  // namespace touchstone
