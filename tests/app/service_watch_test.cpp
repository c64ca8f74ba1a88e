#include "app/service_watch.hpp"

#include <cstdlib>
#include <gtest/gtest.h>

#include "tests/support/notify_socket.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

TEST(ServiceStatus, IsTheStateAndItsReason) {
    TableFrame frame;
    frame.state = "live";
    EXPECT_EQ(status_of(frame), "live");
    frame.state = "sensor_lost";
    frame.note = "The camera was unplugged";
    EXPECT_EQ(status_of(frame), "sensor_lost: The camera was unplugged");
}

/// Ten minutes of frames every 100 ms; the display hangs from the third on.
TEST(ServiceWatch, AHangingDisplayStarvesTheWatchdogThoughFramesGoOn) {
    using namespace std::chrono_literals;
    const TemporaryFolder folder;
    test::NotifySocket socket(folder / "notify");
    setenv("NOTIFY_SOCKET", (folder / "notify").c_str(), 1);
    setenv("WATCHDOG_USEC", "4000000", 1);
    ServiceWatch watch;
    TableFrame frame;
    frame.arrived = std::chrono::steady_clock::now();
    const auto start = std::chrono::steady_clock::now();
    int fed_while_shown = 0, fed_while_hanging = 0;
    for (auto after = 0ms; after < 600s; after += 100ms) {
        const bool hangs = after > 180s;
        if (!hangs) watch.presented(start + after);
        watch.perceived(frame, start + after);
        for (const std::string& message : socket.read(after == 0ms ? 10ms : 0ms))
            if (message == "WATCHDOG=1") ++(after > 195s ? fed_while_hanging : fed_while_shown);
    }
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
    EXPECT_NEAR(fed_while_shown, 190, 2) << "once a second, a quarter of its span";
    EXPECT_EQ(fed_while_hanging, 0);
}

}  // namespace
}  // namespace touchstone
