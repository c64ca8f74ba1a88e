#include "app/touch_outputs.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

#include "tests/platform/output/udp_receiver.hpp"
#include "tests/platform/output/web_socket_client.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;
using testing::Not;

/// With one finger in each area, and one in none.
TouchReport report_of(const std::vector<std::string>& areas) {
    TouchReport report{7, 1'000'000, "live", {}, {}};
    for (std::size_t i = 0; i < areas.size(); ++i) {
        ReportedFinger& finger = report.touches.emplace_back();
        finger.id = static_cast<int>(i) + 1;
        finger.area = areas[i];
        finger.surface = {0.125, 0.125};
        finger.area_surface = {0.75, 0.5};
    }
    return report;
}

const std::string in_area("\x3f\x40\x00\x00\x3f\x00\x00\x00", 8);   // 0.75, 0.5 as OSC floats
const std::string on_table("\x3e\x00\x00\x00\x3e\x00\x00\x00", 8);  // 0.125 twice

/// The next datagram with all of these; empty where there is none among the next eight.
std::string take_with(const UdpReceiver& receiver, const std::vector<std::string>& parts) {
    for (int i = 0; i < 8; ++i) {
        const std::string datagram = receiver.take();
        if (datagram.empty()) break;
        if (std::ranges::all_of(
                parts, [&](const std::string& part) { return datagram.find(part) != std::string::npos; }))
            return datagram;
    }
    return {};
}

const NamedArea left{"left", "", "", {{-100, 0}, {0, 0}, {0, 100}}};
const NamedArea right{"right", "", "second@table", {{0, 0}, {100, 0}, {100, 100}}};

TEST(TouchOutputs, UnaskedThereIsTuioOfTouchesOnly) {
    const UdpReceiver receiver;
    RunOptions options;
    options.config.tuio.port = receiver.port();
    {
        TouchOutputs outputs(options, {});
        EXPECT_THAT(receiver.take(), HasSubstr("/tuio/2Dcur"));
        outputs.publish(report_of({""}));
        EXPECT_NE(take_with(receiver, {on_table}), "");
    }
    const UdpReceiver nobody;
    options.config.tuio.port = nobody.port();
    options.config.tuio.enabled = false;
    TouchOutputs outputs(options, {});
    outputs.publish(report_of({""}));
    EXPECT_EQ(nobody.take(), "");
}

TEST(TouchOutputs, HoversGoToTheirPort) {
    const UdpReceiver touches, hovers;
    RunOptions options;
    options.config.tuio.port = touches.port();
    options.config.tuio.hover_port = hovers.port();
    const TouchOutputs outputs(options, {});
    EXPECT_THAT(touches.take(), HasSubstr("/tuio/2Dcur"));
    EXPECT_THAT(hovers.take(), HasSubstr("/tuio/25Dcur"));
}

TEST(TouchOutputs, WebPagesAreServedWhereTheConfigurationSays) {
    RunOptions options;
    options.config.tuio.enabled = false;
    options.config.tuio.source = "here@table";
    options.config.web_socket_enabled = true;
    { options.config.web_socket.port = WebSocketChannel({.port = 0, .origin = {}}).port(); }
    TouchOutputs outputs(options, {});
    const WebSocketClient client(options.config.web_socket.port);
    ASSERT_TRUE(client.is_open()) << client.answer();
    outputs.release_all();
    const auto message = client.take();
    ASSERT_TRUE(message);
    EXPECT_THAT(message->payload, HasSubstr("here@table"));
    outputs.set_areas(std::vector<NamedArea>{right});
    bool is_told = false;
    for (int i = 0; i < 4 && !is_told; ++i) {
        const auto next = client.take();
        is_told = next && next->payload.find("second@table") != std::string::npos;
    }
    EXPECT_TRUE(is_told) << "over the same connection";
}

TEST(TouchOutputs, EachAreaIsASourceWithPlacesOfItsOwn) {
    const UdpReceiver receiver;
    RunOptions options;
    options.config.tuio.port = receiver.port();
    options.config.tuio.source = "here@table";
    const std::vector<NamedArea> areas{left, right};
    const std::vector<std::string> sources{"here@table-left", "second@table"};
    TouchOutputs outputs(options, areas);
    outputs.publish(report_of({"left", "", "right"}));
    std::set<std::string> sessions;
    const std::string cursor = ",sifffff";
    for (const std::string& source : sources) {
        const std::string told = take_with(receiver, {source, cursor});
        EXPECT_THAT(told, HasSubstr(in_area)) << source;
        EXPECT_THAT(told, Not(HasSubstr(on_table))) << "nor of the finger in none";
        const std::size_t set = told.find(cursor);
        ASSERT_NE(set, std::string::npos);
        EXPECT_EQ(told.find(cursor, set + 1), std::string::npos) << "one cursor";
        sessions.insert(told.substr(set + 16, 4));
    }
    EXPECT_EQ(sessions.size(), 2U) << "ids differ, for clients that look at nothing else";
}

TEST(TouchOutputs, AreasThatChangeEndTheirTouches) {
    const UdpReceiver receiver;
    RunOptions options;
    options.config.tuio.port = receiver.port();
    options.config.tuio.source = "here@table";
    TouchOutputs outputs(options, {});
    outputs.publish(report_of({"right"}));
    ASSERT_NE(take_with(receiver, {",sifffff"}), "");
    outputs.set_areas(std::vector<NamedArea>{right});
    std::string ended;
    for (std::string next = take_with(receiver, {"alive"}); next.find("second@table") == std::string::npos;
         next = take_with(receiver, {"alive"})) {
        ASSERT_NE(next, "");
        ended = next;
    }
    EXPECT_THAT(ended, HasSubstr("here@table"));
    EXPECT_THAT(ended, Not(HasSubstr(",sifffff"))) << "the last that the old source says";
}

}  // namespace
}  // namespace touchstone
