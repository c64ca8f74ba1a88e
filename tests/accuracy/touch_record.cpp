#include "tests/accuracy/touch_record.hpp"

#include <fmt/core.h>
#include <fstream>
#include <nlohmann/json.hpp>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

using Json = nlohmann::json;

std::ifstream open_input(const std::filesystem::path& path) {
    std::ifstream file(path);
    if (!file) throw Error(ExitStatus::no_input, fmt::format("cannot open {}", path.string()));
    return file;
}

TrueTip tip_of(const Json& object) {
    return {object.at("hand"), object.at("finger"), object.at("gap_mm"), object.at("camera_mm")};
}

std::vector<LoggedTouch> touches_of(const Json& line) {
    std::vector<LoggedTouch> touches;
    for (const Json& touch : line.at("touches")) {
        if (touch.value("phase", "") == "up") continue;
        touches.push_back({touch.at("id"), touch.at("camera_mm")});
    }
    return touches;
}

}  // namespace

TouchTruth read_touch_truth(const std::filesystem::path& path) try {
    std::ifstream file = open_input(path);
    const Json document = Json::parse(file);
    TouchTruth truth;
    truth.fps = document.at("fps");
    for (const Json& frame : document.at("tips")) {
        auto& tips = truth.tips.emplace_back();
        for (const Json& tip : frame) tips.push_back(tip_of(tip));
    }
    return truth;
} catch (const Json::exception& error) {
    throw Error(ExitStatus::bad_data,
                fmt::format("{} is no truth of a table: {}", path.string(), error.what()));
}

TouchLog read_touch_log(const std::filesystem::path& path) {
    std::ifstream file = open_input(path);
    TouchLog log;
    int number = 0;
    for (std::string text; std::getline(file, text);) {
        ++number;
        if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
        try {
            const Json line = Json::parse(text);
            log[line.at("frame")] = touches_of(line);
        } catch (const Json::exception& error) {
            throw Error(ExitStatus::bad_data,
                        fmt::format("{} line {} is no event line: {}", path.string(), number, error.what()));
        }
    }
    return log;
}

}  // namespace touchstone
