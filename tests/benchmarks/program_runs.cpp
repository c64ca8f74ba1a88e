#include "tests/benchmarks/program_runs.hpp"

#include <chrono>
#include <fcntl.h>
#include <fmt/core.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "tests/support/run_program.hpp"

namespace touchstone {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

bool says(const std::filesystem::path& path, std::string_view words) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str().find(words) != std::string::npos;
}

/// Starts the program with its standard error in `log`.
pid_t start(std::vector<std::string> command, const std::filesystem::path& log,
            const std::filesystem::path& cache) {
    const pid_t child = fork();
    if (child != 0) return child;
    setenv("XDG_CACHE_HOME", cache.c_str(), 1);
    dup2(open(log.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600), STDERR_FILENO);
    std::vector<char*> arguments;
    for (std::string& word : command) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    execv(arguments[0], arguments.data());
    _exit(127);
}

}  // namespace

ProgramRun run_table(const std::string& program, const std::filesystem::path& folder, int frames) {
    const auto events = folder / "events.jsonl", config = folder / "table.toml";
    std::filesystem::remove(events);
    std::ofstream(config) << fmt::format("[scan]\nfile = '{}'\n", (folder / "table.scan").string());
    const auto start_time = Clock::now();
    const pid_t child =
        start({program, "run", "--display", "headless", "--sensor", "sim:flat?hands=2&empty=4", "--pace",
               "live", "--voxels", "512", "--config", config.string(), "--events", events.string(),
               "--frames", std::to_string(frames)},
              folder / "log", folder / "cache");
    ProgramRun run;
    int status = 0;
    rusage usage{};
    while (wait4(child, &status, WNOHANG, &usage) == 0) {
        if (run.first_live_s <= 0.0 && says(events, R"("state":"live")"))
            run.first_live_s = seconds_since(start_time);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw std::runtime_error(fmt::format("run failed, see {}", (folder / "log").string()));
    run.peak_rss_mb = static_cast<double>(usage.ru_maxrss) * 1024.0 / 1e6;
    run.used_saved_scan = says(folder / "log", "the saved scan fits");
    return run;
}

double bench_moving_ms(const std::string& program, const std::filesystem::path& sequence, int voxels) {
    const test::ProgramResult result =
        test::run_program({program, "bench", "--moving", "--sensor", "seq:" + sequence.string(), "--pace",
                           "step", "--voxels", std::to_string(voxels), "--side", "4.8", "--json", "-"});
    if (result.status != 0) throw std::runtime_error("bench --moving: " + result.err);
    return nlohmann::json::parse(result.out).at("frame_ms").at("median").get<double>();
}

}  // namespace touchstone
