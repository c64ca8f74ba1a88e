#include "app/reset_command.hpp"

#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>

#include "platform/system/atomic_file.hpp"
#include "ui/scene_setup.hpp"

namespace touchstone {

namespace {

namespace fs = std::filesystem;

class Remover {
  public:
    /// With the ones before it, which would come back else.
    void file(const std::string& name) {
        if (name.empty()) return;
        for (const fs::path& path : names_of(name)) remove(path);
    }
    /// With those of areas, also of areas that are there no more.
    void paintings(const std::string& name) {
        if (name.empty()) return;
        file(name);
        const fs::path table(name);
        const std::string prefix = table.filename().string() + area_painting_suffix;
        const fs::path folder = table.has_parent_path() ? table.parent_path() : fs::path(".");
        std::error_code none;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
            if (entry.path().filename().string().starts_with(prefix)) remove(entry.path());
    }
    /// Reports of a folder that may hold other things, too.
    void reports(const std::string& folder) {
        std::error_code none;
        if (folder.empty() || !fs::is_directory(folder, none)) return;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder))
            if (entry.path().filename().string().starts_with("fault-")) remove(entry.path());
    }
    int removed() const { return removed_; }
    const std::string& failure() const { return failure_; }

  private:
    void remove(const fs::path& path) {
        std::error_code code;
        const std::uintmax_t parts = fs::remove_all(path, code);
        if (code) failure_ = "cannot remove " + path.string() + ": " + code.message();
        if (code || parts == 0) return;
        std::printf("removed %s\n", path.c_str());
        ++removed_;
    }

    int removed_ = 0;
    std::string failure_;
};

}  // namespace

ExitStatus reset_command(const ResetOptions& options) {
    const Config& config = options.config;
    Remover remover;
    for (const std::string& file :
         {config.scan_file, config.bias_file, config.projector.file, config.areas_file})
        remover.file(file);
    remover.paintings(config.display.painting_file);
    remover.reports(config.fault_reports.dir);
    if (!remover.failure().empty()) throw Error(ExitStatus::io_error, remover.failure());
    if (remover.removed() == 0) std::printf("nothing to remove\n");
    return ExitStatus::ok;
}

}  // namespace touchstone
