#include "platform/display/connectors.hpp"

#include <algorithm>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;

std::string edid_of(const std::string& model) {
    std::string edid(128, '\0');
    edid[54] = 1;  // the first descriptor is a mode
    edid[72 + 3] = '\xfc';
    const std::string text = (model + "\n             ").substr(0, 13);
    std::ranges::copy(text, edid.begin() + 72 + 5);
    return edid;
}

std::string model_in(const std::string& edid) {
    return model_of_edid({reinterpret_cast<const std::uint8_t*>(edid.data()), edid.size()});
}

TEST(Connectors, ModelOfAnEdid) {
    EXPECT_EQ(model_in(edid_of("EPSON PJ")), "EPSON PJ");
    EXPECT_EQ(model_in(edid_of("ABCDEFGHIJKLMNOP")), "ABCDEFGHIJKLM") << "thirteen fit";
    EXPECT_EQ(model_in(std::string(128, '\0')), "");
    EXPECT_EQ(model_in(edid_of("EPSON PJ").substr(0, 80)), "") << "cut off";
    EXPECT_EQ(model_in(""), "");
}

class KernelFolder : public testing::Test {
  protected:
    void add(const std::string& name, const std::string& status, const std::string& modes,
             const std::string& model) {
        const std::filesystem::path folder = drm_ / name;
        std::filesystem::create_directory(folder);
        std::ofstream(folder / "status") << status << "\n";
        std::ofstream(folder / "modes") << modes;
        if (!model.empty()) std::ofstream(folder / "edid", std::ios::binary) << edid_of(model);
    }

    TemporaryFolder drm_;
};

TEST_F(KernelFolder, TellsConnectorsAndWhatIsInThem) {
    add("card0-HDMI-A-1", "connected", "1280x800\n1280x800\n1920x1080i\n", "EPSON PJ");
    add("card0-DP-1", "disconnected", "", "");
    std::ofstream(drm_ / "version") << "drm 1.1.0\n";
    std::filesystem::create_directory(drm_ / "card0");
    const std::vector<Connector> connectors = list_connectors(drm_.path());
    ASSERT_EQ(connectors.size(), 2U);
    EXPECT_EQ(connectors[0].name, "DP-1");
    EXPECT_FALSE(connectors[0].connected);
    EXPECT_EQ(connectors[1].model, "EPSON PJ");
    EXPECT_THAT(connectors[1].sizes, testing::ElementsAre(PixelSize{1280, 800}, PixelSize{1920, 1080}));
    EXPECT_EQ(list_text(outputs_of(connectors)), "HDMI-A-1 EPSON PJ (1280x800; 1920x1080)");
    EXPECT_TRUE(is_connected("HDMI-A-1", drm_.path()));
    EXPECT_FALSE(is_connected("DP-1", drm_.path()));
    EXPECT_FALSE(is_connected("DP-2", drm_.path()));
    EXPECT_TRUE(list_connectors(drm_ / "none").empty());
    ASSERT_EQ(in_card_order(connectors, drm_ / "none").size(), 1U) << "only what is connected";
}

TEST(Connectors, NameTheOutputsOfWindowSystems) {
    const std::vector<Connector> plugged{{"HDMI-A-1", "EPSON PJ", true, {}},
                                         {"eDP-1", "", true, {}},
                                         {"DP-1", "DELL", true, {}},
                                         {"HDMI-A-2", "EPSON PJ", true, {}}};
    const auto names = [&](const std::vector<std::string>& given) {
        std::vector<Output> outputs;
        for (const std::string& name : given) outputs.push_back({name, {}, {}});
        std::vector<std::string> result;
        for (const Output& output : named_after_connectors(outputs, plugged)) result.push_back(output.name);
        return result;
    };
    using testing::ElementsAre;
    EXPECT_THAT(names({"eDP-1", "EPSON PJ 24\"", "EPSON PJ 24\""}),
                ElementsAre("eDP-1", "HDMI-A-1 EPSON PJ 24\"", "HDMI-A-2 EPSON PJ 24\""));
    EXPECT_THAT(names({"0", "1"}), ElementsAre("HDMI-A-1 EPSON PJ", "eDP-1")) << "a bare console";
    EXPECT_THAT(names({"eDP-1", "DELL"}), ElementsAre("eDP-1", "DP-1 DELL"));
    EXPECT_THAT(names({"Seiko EPSON PJ (HDMI-A-2)"}), ElementsAre("Seiko EPSON PJ (HDMI-A-2)"));
    EXPECT_THAT(names({"screen", "7"}), ElementsAre("screen", "eDP-1"));
    EXPECT_THAT(names({"a", "b", "c", "d", "7"}), ElementsAre("a", "b", "c", "d", "7"))
        << "more than there are";
}

TEST_F(KernelFolder, AConsoleWithoutCardsRightsOrScreensSaysSo) {
    const TemporaryFolder dri;
    EXPECT_THAT(console_problem(dri / "none", drm_.path()), HasSubstr("/none/card*"));
    std::ofstream(dri / "card0") << "";
    EXPECT_THAT(console_problem(dri.path(), drm_.path()), HasSubstr("switch it on"));
    add("card0-HDMI-A-1", "connected", "1280x800\n", "");
    EXPECT_EQ(console_problem(dri.path(), drm_.path()), "");
    std::filesystem::permissions(dri / "card0", std::filesystem::perms::none);
    if (access((dri / "card0").c_str(), R_OK) != 0) {  // root may open everything
        EXPECT_THAT(console_problem(dri.path(), drm_.path()), HasSubstr("usermod"));
    }
}

}  // namespace
}  // namespace touchstone
