// Whoever takes the touches is gone, or sends megabytes back.
#include <array>
#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <thread>

#include "platform/output/tuio_sink.hpp"
#include "platform/output/udp_channel.hpp"
#include "platform/output/web_socket_channel.hpp"
#include "platform/system/process_memory.hpp"
#include "tests/platform/output/tuio_reference_client.hpp"
#include "tests/platform/output/udp_receiver.hpp"
#include "tests/platform/output/web_socket_client.hpp"

namespace touchstone {
namespace {

using namespace std::chrono_literals;

TouchReport report_of(int frame) {
    TouchReport report;
    report.frame = frame;
    report.time_us = static_cast<std::uint64_t>(frame) * 33'333;
    report.touches.push_back({.id = 1, .phase = ReportedPhase::move, .surface = {0.001 * frame, 0.5}});
    return report;
}

/// No frame may wait for a receiver.
constexpr auto longest_publish = 20ms;

template <class Publish>
std::chrono::steady_clock::duration longest_of(int frames, Publish publish) {
    std::chrono::steady_clock::duration longest{};
    for (int frame = 0; frame < frames; ++frame) {
        const auto begin = std::chrono::steady_clock::now();
        publish(frame);
        longest = std::max(longest, std::chrono::steady_clock::now() - begin);
    }
    return longest;
}

TEST(Receivers, OneThatIsGoneAndComesBackGetsTheTouches) {
    auto receiver = std::make_unique<UdpReceiver>();
    const int port = receiver->port();
    TuioSink sink(std::make_unique<UdpChannel>("127.0.0.1", port), "table");
    sink.publish(report_of(0));
    EXPECT_FALSE(receiver->take().empty());
    receiver.reset();  // from now on each datagram is answered with an ICMP that refuses it
    EXPECT_LT(longest_of(200, [&](int frame) { sink.publish(report_of(frame)); }), longest_publish);
    receiver = std::make_unique<UdpReceiver>(port);
    sink.publish(report_of(201));
    sink.publish(report_of(202));
    EXPECT_FALSE(receiver->take().empty()) << "every one of them, the first included, may be lost";
}

TEST(Receivers, OneThatFloodsBackByUdpHoldsUpNothing) {
    const UdpReceiver receiver;
    TuioSink sink(std::make_unique<UdpChannel>("127.0.0.1", receiver.port()), "table");
    std::array<char, 4096> datagram{};
    sockaddr_in sender{};
    socklen_t size = sizeof sender;
    ASSERT_GT(::recvfrom(receiver.socket(), datagram.data(), datagram.size(), 0,
                         reinterpret_cast<sockaddr*>(&sender), &size),
              0);
    const double before_mb = resident_mb();
    std::atomic<bool> over = false;
    std::thread flood([&] {
        const std::string bytes(60'000, 'x');
        for (int i = 0; i < 2000; ++i)  // 120 MB
            (void)!::sendto(receiver.socket(), bytes.data(), bytes.size(), MSG_DONTWAIT,
                            reinterpret_cast<sockaddr*>(&sender), size);
        over = true;
    });
    int published = 0;
    while (!over || published < 100) sink.publish(report_of(published++));
    flood.join();
    EXPECT_LT(resident_mb() - before_mb, 20.0);
    (void)receiver.take_all();
    sink.publish(report_of(published));
    EXPECT_FALSE(receiver.take().empty());
}

/// One client sends frames of its own, as fast as they are taken, and never reads; another listens.
TEST(Receivers, AWebPageThatFloodsBackTakesNothingFromTheOthers) {
    auto channel =
        std::make_unique<WebSocketChannel>(WebSocketConfig{.host = "127.0.0.1", .port = 0, .origin = {}});
    const int port = channel->port();
    TuioSink sink(std::move(channel), "table");
    const WebSocketClient flooding(port), listener(port);
    ASSERT_TRUE(flooding.is_open() && listener.is_open());
    const double before_mb = resident_mb();
    std::atomic<bool> over = false;
    std::thread flood([&] {
        // A masked binary message of 64 KiB, the mask zeros.
        std::string message =
            "\x82\xff" + std::string(5, '\0') + "\x01" + std::string(2, '\0') + std::string(4, '\0');
        message += std::string(65536, 'x');
        for (int i = 0; i < 600; ++i) flooding.tcp().write(message);  // 39 MB
        over = true;
    });
    int published = 0, heard = 0;
    do {
        const auto begin = std::chrono::steady_clock::now();
        sink.publish(report_of(published++));
        EXPECT_LT(std::chrono::steady_clock::now() - begin, longest_publish);
        heard += listener.take().has_value();
        std::this_thread::sleep_for(2ms);
    } while (!over || published < 50);
    flood.join();
    EXPECT_GE(heard, published - 2);
    EXPECT_LT(resident_mb() - before_mb, 30.0);
}

/// A board without a clock of its own starts in the past: what it says is taken all the same.
TEST(Receivers, OneThatKnowsAProcessOfTheFutureTakesTheTouchesOfThisOne) {
    TuioReferenceClient client;
    const auto now = std::chrono::system_clock::now();
    const TuioSession::Clock::time_point tick{};
    for (const auto shift : {0s, -86'400s, 1s, -1s, -30s}) {
        TuioSession session(tuio_start(now + shift));
        client.take(session.start(tick));
        client.take(session.frame(report_of(1), tick));
        EXPECT_EQ(client.cursors.size(), 1u) << shift.count();
        client.take(session.frame(report_of(2), tick));
        EXPECT_EQ(client.cursors.size(), 1u) << shift.count();
        client.take(session.release_all(tick));
        EXPECT_TRUE(client.cursors.empty()) << shift.count();
    }
}

}  // namespace
}  // namespace touchstone
