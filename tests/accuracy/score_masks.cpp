// score_masks TRUTH_DIR MAPS_DIR: the figures as JSON on standard output, a line for people on
// standard error.
#include <iostream>

#include "platform/system/error.hpp"
#include "tests/accuracy/mask_score.hpp"

int main(int argc, char** argv) try {
    if (argc != 3) {
        std::cerr << "usage: score_masks TRUTH_DIR MAPS_DIR\n";
        return static_cast<int>(touchstone::ExitStatus::usage);
    }
    const auto score = touchstone::score_masks(argv[1], argv[2]);
    std::cout << touchstone::json_of(score) << '\n';
    std::cerr << touchstone::line_of(score) << '\n';
    return 0;
} catch (const touchstone::Error& error) {
    std::cerr << "score_masks: " << error.what() << '\n';
    return static_cast<int>(error.status());
}
