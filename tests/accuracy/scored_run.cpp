#include "tests/accuracy/scored_run.hpp"

#include <fstream>
#include <stdexcept>

#include "tests/support/run_program.hpp"

namespace touchstone {

TouchLog logged_run(const std::string& program, const std::string& sensor) {
    const TemporaryFolder folder;
    const std::string events = (folder / "events.jsonl").string();
    // A display as small as can be: the picture is not what is scored.
    std::ofstream(folder / "table.toml")
        << "[display]\nwidth_px = 160\nheight_px = 120\n[tuio]\nenabled = false\n";
    const test::ProgramResult result =
        test::run_program({program, "run", "--sensor", sensor, "--pace", "step", "--display", "headless",
                           "--events", events, "--config", (folder / "table.toml").string()});
    if (result.status != 0) throw std::runtime_error(sensor + ": " + result.err);
    return read_touch_log(events);
}

TouchScore scored_run(const std::string& program, const std::string& scene, int seed, int frames) {
    const TemporaryFolder folder;
    const std::string truth = (folder / "truth.json").string();
    const TouchLog log = logged_run(program, "sim:" + scene + "?hands=2&seed=" + std::to_string(seed) +
                                                 "&frames=" + std::to_string(frames) + "&truth=" + truth);
    return score_touches(read_touch_truth(truth), log);
}

}  // namespace touchstone
