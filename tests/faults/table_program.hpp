#pragma once

#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/comes_true.hpp"
#include "tests/support/run_program.hpp"

namespace touchstone::test {

/// A folder with a configuration that keeps everything there is to keep, for tables that start quickly.
class TableFolder {
  public:
    explicit TableFolder(const std::string& more = {}) { configure(more); }

    /// `more` begins within the section of the scan. The state lies beside the configuration, or elsewhere.
    void configure(const std::string& more, const std::string& state_folder = {}) const {
        const std::string state = state_folder.empty() ? folder_.path().string() : state_folder;
        std::ofstream(config())
            << "[display]\nwidth_px = 160\nheight_px = 120\nattract_after_s = 0\npainting_file = \"" << state
            << "/table.painting\"\n[volume]\nsize_vox = 64\n[projector]\nfile = \"" << state
            << "/projector.calibration\"\n[scan]\nfile = \"" << state << "/table.scan\"\n"
            << more;
    }
    std::string config() const { return (folder_ / "table.toml").string(); }
    std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
    const std::filesystem::path& path() const { return folder_.path(); }

    std::vector<std::string> command(const std::string& sensor, std::vector<std::string> more = {}) const {
        std::vector<std::string> words{
            TOUCHSTONE_PROGRAM, "run",    "--display", "headless",
            "--config",         config(), "--events",  (folder_ / "events").string(),
            "--sensor",         sensor};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    /// The line of events that was written last; null where there is none.
    nlohmann::json last_event() const {
        std::ifstream file(folder_ / "events");
        nlohmann::json last;
        for (std::string line; std::getline(file, line) && !file.eof();) last = nlohmann::json::parse(line);
        return last;
    }
    int events() const {
        std::ifstream file(folder_ / "events");
        int lines = 0;
        for (std::string line; std::getline(file, line);) ++lines;
        return lines;
    }
    bool comes_to(const std::string& state) const {
        return comes_true([&] {
            const nlohmann::json last = last_event();
            return last.is_object() && last["state"] == state;
        });
    }

  private:
    TemporaryFolder folder_;
};

}  // namespace touchstone::test
