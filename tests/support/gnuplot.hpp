#pragma once

#include <fstream>
#include <stdexcept>

#include "tests/support/run_program.hpp"

namespace touchstone::test {

/// Draws what a script says. Throws std::runtime_error, which says what to install where gnuplot is missing.
inline void run_gnuplot(const std::string& script) {
    constexpr int not_found = 127;
    const TemporaryFolder folder;
    const std::string file = (folder / "chart.gnuplot").string();
    std::ofstream(file) << script;
    const ProgramResult result = run_program({"/usr/bin/env", "gnuplot", file});
    if (result.status == not_found)
        throw std::runtime_error(
            "no chart without gnuplot: apt-get install --no-install-recommends gnuplot-nox");
    if (result.status != 0) throw std::runtime_error("gnuplot: " + result.err);
}

}  // namespace touchstone::test
