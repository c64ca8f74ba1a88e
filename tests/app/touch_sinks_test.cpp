#include "app/touch_sinks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/platform/output/udp_receiver.hpp"
#include "tests/platform/output/web_socket_client.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST(TouchSinks, UnaskedThereIsTuioOfTouchesOnly) {
    const UdpReceiver receiver;
    RunOptions options;
    options.config.tuio.port = receiver.port();
    EXPECT_THAT(make_touch_sinks(options), SizeIs(1));
    EXPECT_THAT(receiver.take(), HasSubstr("/tuio/2Dcur"));
    options.config.tuio.enabled = false;
    EXPECT_THAT(make_touch_sinks(options), IsEmpty());
}

TEST(TouchSinks, HoversGoToTheirPort) {
    const UdpReceiver touches, hovers;
    RunOptions options;
    options.config.tuio.port = touches.port();
    options.config.tuio.hover_port = hovers.port();
    EXPECT_THAT(make_touch_sinks(options), SizeIs(2));
    EXPECT_THAT(touches.take(), HasSubstr("/tuio/2Dcur"));
    EXPECT_THAT(hovers.take(), HasSubstr("/tuio/25Dcur"));
}

TEST(TouchSinks, WebPagesAreServedWhereTheConfigurationSays) {
    RunOptions options;
    options.config.tuio.enabled = false;
    options.config.tuio.source = "here@table";
    options.config.web_socket_enabled = true;
    { options.config.web_socket.port = WebSocketChannel({.port = 0, .origin = {}}).port(); }
    const auto sinks = make_touch_sinks(options);
    ASSERT_THAT(sinks, SizeIs(1));
    const WebSocketClient client(options.config.web_socket.port);
    ASSERT_TRUE(client.is_open()) << client.answer();
    sinks[0]->release_all();
    const auto message = client.take();
    ASSERT_TRUE(message);
    EXPECT_THAT(message->payload, HasSubstr("here@table"));
}

}  // namespace
}  // namespace touchstone
