// score_touches TRUTH.json EVENTS.jsonl: the figures as JSON on standard output, a line for people on
// standard error.
#include <iostream>

#include "platform/system/error.hpp"
#include "tests/accuracy/touch_score.hpp"

int main(int argc, char** argv) try {
    if (argc != 3) {
        std::cerr << "usage: score_touches TRUTH.json EVENTS.jsonl\n";
        return static_cast<int>(touchstone::ExitStatus::usage);
    }
    const auto score =
        touchstone::score_touches(touchstone::read_touch_truth(argv[1]), touchstone::read_touch_log(argv[2]));
    std::cout << touchstone::json_of(score) << '\n';
    std::cerr << touchstone::line_of(score) << '\n';
    return 0;
} catch (const touchstone::Error& error) {
    std::cerr << "score_touches: " << error.what() << '\n';
    return static_cast<int>(error.status());
}
