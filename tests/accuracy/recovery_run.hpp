#pragma once

#include <cstdint>
#include <string>

namespace touchstone {

/// A simulated camera that fails again and again, and the program that lives with it.
struct RecoveryRun {
    std::string program;
    int faults = 200;  ///< the run ends when so many have happened
    int hands = 2;
    int seed = 101;
    double every_s = 1.5;  ///< between faults, on average
    double fault_s = 0.5;  ///< that an unplugged camera stays away, and a silent one is silent unless helped
};

struct RecoveryScore {
    int faults = 0, restarts = 0;
    int frames = 0;
    double seconds = 0.0;
    double longest_gap_s = 0.0;  ///< between two processed frames, on the host's clock
    int downs = 0;
    int left_touches = 0;     ///< that neither moved nor went up in the frame after their camera's return
    int confused_events = 0;  ///< moves or ups of what was not down, downs of what was
    double early_mb = 0.0, late_mb = 0.0;  ///< resident memory after a tenth of the faults, and at the end
    int early_files = 0, late_files = 0;   ///< open descriptors
    int exit_status = -1;                  ///< after SIGTERM
};

/// Throws std::runtime_error where the program ends by itself or shows no figures for a minute.
RecoveryScore run_recovery(const RecoveryRun& run);

}  // namespace touchstone
