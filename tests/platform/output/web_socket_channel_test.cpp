#include "platform/output/web_socket_channel.hpp"

#include <bit>
#include <deque>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "platform/output/tuio_sink.hpp"
#include "platform/system/process_memory.hpp"
#include "tests/platform/output/web_socket_client.hpp"
#include "tests/support/expect_error.hpp"

namespace touchstone {
namespace {

using namespace std::string_literals;
using testing::AllOf;
using testing::HasSubstr;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool keeps_what_is_freed = true;
#else
constexpr bool keeps_what_is_freed = false;
#endif

TouchReport report_of(int fingers, double u) {
    TouchReport report;
    for (int id = 0; id < fingers; ++id)
        report.touches.push_back({.id = id, .phase = ReportedPhase::move, .surface = {u, 0.5}});
    return report;
}

/// A TUIO sink on a port of its own.
class WebSocketTest : public testing::Test {
  protected:
    explicit WebSocketTest(const std::string& origin = {}) {
        auto channel = std::make_unique<WebSocketChannel>(WebSocketConfig{.port = 0, .origin = origin});
        port_ = channel->port();
        sink_ = std::make_unique<TuioSink>(std::move(channel), "table@127.0.0.1");
    }
    /// Messages of a client until one has `bytes`; false where they end before.
    static bool gets(const WebSocketClient& client, const std::string& bytes) {
        while (const auto message = client.take())
            if (message->payload.find(bytes) != std::string::npos) return true;
        return false;
    }
    static std::string osc_number(float value) {
        const auto bits = std::bit_cast<std::uint32_t>(value);
        std::string bytes;
        for (const unsigned shift : {24u, 16u, 8u, 0u}) bytes += static_cast<char>(bits >> shift & 0xffu);
        return bytes;
    }
    /// The server still tells the touches to who comes now.
    void expect_it_lives() {
        const WebSocketClient client(port_);
        ASSERT_TRUE(client.is_open()) << client.answer();
        sink_->publish(report_of(1, 0.375));
        EXPECT_TRUE(gets(client, osc_number(0.375f)));
    }

    int port_ = 0;
    std::unique_ptr<TuioSink> sink_;
};

TEST_F(WebSocketTest, EveryClientGetsEachBundleAsABinaryMessage) {
    const WebSocketClient one(port_), two(port_);
    ASSERT_TRUE(one.is_open()) << one.answer();
    ASSERT_TRUE(two.is_open()) << two.answer();
    sink_->publish(report_of(2, 0.25));
    const auto at_one = one.take(), at_two = two.take();
    ASSERT_TRUE(at_one && at_two);
    EXPECT_EQ(at_one->opcode, 2u) << "binary";
    EXPECT_EQ(at_one->payload, at_two->payload);
    const auto bundles =
        osc_bundles({.alive = {1, 2}, .cursors = {{.session = 1, .x = 0.25f, .y = 0.5f}, {.session = 2}}},
                    TuioProfile::cursors_2d, "table@127.0.0.1", 1472);
    EXPECT_EQ(at_one->payload.size(), osc_bytes(bundles[0]).size());
    EXPECT_TRUE(at_one->payload.starts_with(osc_bytes(bundles[0]).substr(0, 76)))
        << "bundle, source and the head of alive";
}

TEST_F(WebSocketTest, TheLastWordsAreThatAllIsOver) {
    const WebSocketClient client(port_);
    sink_->publish(report_of(1, 0.5));
    sink_.reset();
    std::string last;
    while (const auto message = client.take()) {
        if (message->opcode == 2) last = message->payload;
    }
    EXPECT_THAT(last, HasSubstr(",s\0\0alive\0\0\0"s));
}

TEST_F(WebSocketTest, AClientThatReadsNothingHoldsUpNobodyAndCostsNoMemory) {
    const WebSocketClient stuck(port_);
    ASSERT_TRUE(stuck.is_open());
    const WebSocketClient reader(port_);
    ASSERT_TRUE(reader.is_open());
    const double before_mb = resident_mb();
    for (int i = 0; i < 6000; ++i) sink_->publish(report_of(50, i / 6000.0));
    if (!keeps_what_is_freed) {
        EXPECT_LT(resident_mb() - before_mb, 8.0) << "19 MB were sent";
    }
    sink_->publish(report_of(50, 1.0));
    EXPECT_TRUE(gets(reader, osc_number(1.0f)));
}

TEST_F(WebSocketTest, AClientThatWakesUpGetsTheLatest) {
    const WebSocketClient client(port_);
    for (int i = 0; i < 2000; ++i) sink_->publish(report_of(50, 0.25));
    sink_->publish(report_of(50, 0.875));
    EXPECT_TRUE(gets(client, osc_number(0.875f)));
}

TEST_F(WebSocketTest, IsForThisMachineOnly) {
    EXPECT_TRUE(TcpClient(port_).is_connected());
    EXPECT_FALSE(TcpClient(port_, "127.0.0.2").is_connected()) << "another address of this machine";
}

TEST_F(WebSocketTest, PagesOfOtherMachinesMayNotListen) {
    EXPECT_TRUE(WebSocketClient(port_, "Origin: http://localhost:8000\r\n").is_open());
    EXPECT_FALSE(WebSocketClient(port_, "Origin: https://example.com\r\n").is_open());
    EXPECT_FALSE(WebSocketClient(port_, "Origin: http://" + std::string(1000, 'a') + "\r\n").is_open());
    expect_it_lives();
}

class WebSocketForAll : public WebSocketTest {
  protected:
    WebSocketForAll() : WebSocketTest("*") {}
};

TEST_F(WebSocketForAll, UnlessTheyAreAllowedTo) {
    EXPECT_TRUE(WebSocketClient(port_, "Origin: https://example.com\r\n").is_open());
}

TEST_F(WebSocketTest, APlainRequestIsNoClient) {
    const TcpClient browser(port_);
    browser.write("GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
    EXPECT_THAT(browser.read_until("\r\n"), HasSubstr("404"));
    expect_it_lives();
}

std::string random_bytes(std::mt19937& random, std::size_t most) {
    std::string bytes(std::uniform_int_distribution<std::size_t>(1, most)(random), '\0');
    std::uniform_int_distribution<int> byte(0, 255);
    for (char& each : bytes) each = static_cast<char>(byte(random));
    return bytes;
}

TEST_F(WebSocketTest, GarbageInPlaceOfAHandshakeIsSurvived) {
    std::mt19937 random(7);
    for (int i = 0; i < 300; ++i) {
        std::string handshake = WebSocketClient::handshake("Origin: http://localhost\r\n");
        const std::size_t place = random() % handshake.size();
        switch (i % 6) {
            case 0:
                handshake = random_bytes(random, 3000);
                break;
            case 1:
                handshake.resize(place);
                break;
            case 2:
                handshake[place] = static_cast<char>(random() & 0xffu);
                break;
            case 3:
                handshake.insert(place, random_bytes(random, 200));
                break;
            case 4:
                handshake.insert(handshake.find("Host"), "X: " + std::string(20'000, 'x') + "\r\n");
                break;
            case 5:
                handshake = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + random_bytes(random, 500);
                break;
        }
        TcpClient(port_).write(handshake);
    }
    expect_it_lives();
}

TEST_F(WebSocketTest, GarbageAfterTheHandshakeIsSurvived) {
    std::mt19937 random(8);
    for (int i = 0; i < 300; ++i) {
        const TcpClient client(port_);
        client.write(WebSocketClient::handshake() + random_bytes(random, 4000));
        sink_->publish(report_of(3, 0.5));
        // A frame that claims to be 2^62 bytes long.
        if (i % 3 == 0) client.write("\x82\xff\x40\0\0\0\0\0\0\0"s + random_bytes(random, 100));
    }
    expect_it_lives();
}

TEST_F(WebSocketTest, ManyConnectionsThatSayNothingAreSurvived) {
    {
        std::deque<TcpClient> silent;
        for (int i = 0; i < 400; ++i) silent.emplace_back(port_);
        sink_->publish(report_of(1, 0.5));
    }
    expect_it_lives();
}

TEST_F(WebSocketTest, ATakenPortIsSaid) {
    expect_error([&] { WebSocketChannel again({.port = port_, .origin = {}}); }, ExitStatus::unavailable,
                 AllOf(HasSubstr("websocket: 127.0.0.1:" + std::to_string(port_)),
                       HasSubstr("[websocket] host, port")));
    expect_error([] { WebSocketChannel({.host = "203.0.113.7", .port = 0, .origin = {}}); },
                 ExitStatus::unavailable, HasSubstr("203.0.113.7"));
}

}  // namespace
}  // namespace touchstone
