#include "platform/output/health_page.hpp"

#include <arpa/inet.h>
#include <array>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/support/expect_error.hpp"

namespace touchstone {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// What a GET of the page at this address gives, head and all; empty where nobody answers.
std::string get(const std::string& host, int port) {
    const int connection = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    inet_pton(AF_INET, host.c_str(), &address.sin_addr);
    std::string answer;
    if (connect(connection, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
        const std::string request = "GET /metrics HTTP/1.0\r\n\r\n";
        (void)!write(connection, request.data(), request.size());
        std::array<char, 4096> bytes{};
        for (ssize_t count = 1; count > 0;) {
            count = read(connection, bytes.data(), bytes.size());
            if (count > 0) answer.append(bytes.data(), static_cast<std::size_t>(count));
        }
    }
    close(connection);
    return answer;
}

TEST(HealthPage, ShowsTheLatestFigures) {
    HealthPage page(0);
    HealthFigures figures;
    figures.state = "live";
    figures.frames = 1799;
    figures.faults["frozen"] = 2;
    figures.unsaved["scan"] = 3;
    figures.stages = {{"frame", 9.5, 14.25, 300}};
    figures.temperatures = {{"cpu-thermal", 61.5}};
    page.show(figures);
    const std::string text = get("127.0.0.1", page.port());
    EXPECT_THAT(text, Not(HasSubstr("lost_packets"))) << "a camera that does not tell";
    EXPECT_THAT(text, HasSubstr("200 OK"));
    EXPECT_THAT(text, HasSubstr("# TYPE touchstone_frames_total counter\ntouchstone_frames_total 1799"));
    EXPECT_THAT(text, HasSubstr("touchstone_camera_faults_total{kind=\"frozen\"} 2"));
    EXPECT_THAT(text, HasSubstr("touchstone_unsaved_total{what=\"scan\"} 3"));
    EXPECT_THAT(text, HasSubstr("touchstone_state{state=\"live\"} 1"));
    EXPECT_THAT(text, HasSubstr("touchstone_stage_milliseconds{stage=\"frame\",quantile=\"0.99\"} 14.25"));
    EXPECT_THAT(text, HasSubstr("touchstone_temperature_celsius{zone=\"cpu-thermal\"} 61.5"));
    figures.state = "sensor_lost";
    figures.lost_packets = 12;
    page.show(figures);
    const std::string later = get("127.0.0.1", page.port());
    EXPECT_THAT(later, HasSubstr("touchstone_state{state=\"sensor_lost\"} 1"));
    EXPECT_THAT(later, HasSubstr("touchstone_lost_packets_total 12"));
}

TEST(HealthPage, IsForThisMachineOnly) {
    const HealthPage page(0);
    EXPECT_NE(get("127.0.0.1", page.port()), "");
    EXPECT_EQ(get("127.0.0.2", page.port()), "") << "another address of this machine";
}

TEST(HealthPage, ATakenPortIsSaid) {
    const HealthPage page(0);
    expect_error([&] { HealthPage again(page.port()); }, ExitStatus::unavailable, HasSubstr("health.port"));
}

}  // namespace
}  // namespace touchstone
