#pragma once

#include <cstdio>
#include <exception>

namespace touchstone::test {

/// What `run` gives; 65 and one line on standard error where it throws.
inline int run_main(const char* name, int (*run)(int, char**), int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", name, error.what());
        return 65;
    }
}

}  // namespace touchstone::test
