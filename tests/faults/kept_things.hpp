#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace touchstone::test {

/// A kind of file that a table keeps for its next start. What is saved is told apart by a number.
struct KeptThing {
    std::string name;
    std::function<void(const std::filesystem::path&, int number)> save;
    /// Throws Error where there is nothing whole.
    std::function<int(const std::filesystem::path&)> load;
    bool is_checked = true;  ///< else it is text for people, in which another digit is no damage
};

inline void PrintTo(const KeptThing& thing, std::ostream* out) { *out << thing.name; }

/// Scan, calibration of the projector, bias of touches, painting, named areas.
std::vector<KeptThing> kept_things();

/// How often a fault is tried: `quick` with the other tests, `full` with toolchain/faults.
int times(int quick, int full);

}  // namespace touchstone::test
