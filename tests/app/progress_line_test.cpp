#include "app/progress_line.hpp"

#include <gtest/gtest.h>
#include <sstream>

namespace touchstone {
namespace {

using namespace std::chrono_literals;

TEST(ProgressLine, EachTextReplacesTheLastAndTheEndClearsIt) {
    std::ostringstream terminal;
    {
        ProgressLine line(terminal, true, 0ms);
        line.show("1 of 9");
        line.show("2 of 9");
    }
    EXPECT_EQ(terminal.str(), "\r\x1b[K1 of 9\r\x1b[K2 of 9\r\x1b[K");
}

TEST(ProgressLine, TextsThatComeTooFastAreLeftOut) {
    std::ostringstream terminal;
    ProgressLine line(terminal, true, 1h);
    line.show("1 of 9");
    line.show("2 of 9");
    EXPECT_EQ(terminal.str(), "\r\x1b[K1 of 9");
}

TEST(ProgressLine, SilentWithoutATerminal) {
    std::ostringstream file;
    {
        ProgressLine line(file, false, 0ms);
        line.show("1 of 9");
    }
    EXPECT_EQ(file.str(), "");
}

}  // namespace
}  // namespace touchstone
