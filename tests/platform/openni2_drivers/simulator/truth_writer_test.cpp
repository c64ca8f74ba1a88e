#include "platform/openni2_drivers/simulator/truth_writer.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "platform/system/error.hpp"

namespace touchstone::sim {
namespace {

nlohmann::json read(const std::filesystem::path& path) {
    std::ifstream file(path);
    return nlohmann::json::parse(file);
}

TEST(TruthWriter, TheFileIsWholeAfterEveryFrame) {
    const std::filesystem::path path = testing::TempDir() + "truth_writer_test.json";
    TruthWriter writer(path, 30.0);
    EXPECT_EQ(read(path), nlohmann::json::parse(R"({"fps":30,"frames":0,"tips":[]})"));
    writer.add_frame({});
    EXPECT_EQ(read(path), nlohmann::json::parse(R"({"fps":30,"frames":1,"tips":[[]]})"));
    writer.add_frame({{0, 0, 0.125F, {1.0F, -2.5F, 900.0F}}, {1, 1, 20.0F, {3.0F, 4.0F, 950.25F}}});
    writer.add_frame({});
    EXPECT_EQ(read(path), nlohmann::json::parse(R"({"fps":30,"frames":3,"tips":[[],
        [{"hand":0,"finger":0,"gap_mm":0.125,"camera_mm":[1.0,-2.5,900.0]},
         {"hand":1,"finger":1,"gap_mm":20.0,"camera_mm":[3.0,4.0,950.25]}],[]]})"));
    std::filesystem::remove(path);
}

TEST(TruthWriter, AFolderThatIsNotThereIsAnIoError) {
    try {
        TruthWriter writer("/nowhere/at/all/truth.json", 30.0);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), ExitStatus::io_error);
        EXPECT_NE(std::string(error.what()).find("/nowhere/at/all/truth.json"), std::string::npos);
    }
}

}  // namespace
}  // namespace touchstone::sim
