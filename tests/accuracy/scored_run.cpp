#include "tests/accuracy/scored_run.hpp"

#include <fstream>
#include <stdexcept>

#include "tests/support/run_program.hpp"

namespace touchstone {

TouchScore scored_run(const std::string& program, const std::string& scene, int seed, int frames) {
    const TemporaryFolder folder;
    const std::string truth = (folder / "truth.json").string(), events = (folder / "events.jsonl").string();
    // A display as small as can be: the picture is not what is scored.
    std::ofstream(folder / "table.toml")
        << "[display]\nwidth_px = 160\nheight_px = 120\n[tuio]\nenabled = false\n";
    const std::string sensor = "sim:" + scene + "?hands=2&seed=" + std::to_string(seed) +
                               "&frames=" + std::to_string(frames) + "&truth=" + truth;
    const test::ProgramResult result =
        test::run_program({program, "run", "--sensor", sensor, "--pace", "step", "--display", "headless",
                           "--events", events, "--config", (folder / "table.toml").string()});
    if (result.status != 0) throw std::runtime_error(sensor + ": " + result.err);
    return score_touches(read_touch_truth(truth), read_touch_log(events));
}

}  // namespace touchstone
