#include "platform/output/tuio_sink.hpp"

#include <bit>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "platform/output/udp_channel.hpp"
#include "tests/platform/output/udp_receiver.hpp"
#include "tests/support/expect_error.hpp"

namespace touchstone {
namespace {

using testing::EndsWith;
using testing::SizeIs;
using testing::StartsWith;

// OSC 1.0, written out independently of the library that the sink uses.
std::string osc_int(std::int32_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    std::string bytes;
    for (const unsigned shift : {24u, 16u, 8u, 0u})
        bytes.push_back(static_cast<char>((bits >> shift) & 0xffu));
    return bytes;
}
std::string osc_float(float value) { return osc_int(std::bit_cast<std::int32_t>(value)); }
std::string osc_string(std::string text) {
    text.resize(text.size() / 4 * 4 + 4, '\0');
    return text;
}
std::string osc_message(const std::string& types, const std::string& arguments,
                        const std::string& address = "/tuio/2Dcur") {
    const std::string message = osc_string(address) + osc_string(types) + arguments;
    return osc_int(static_cast<std::int32_t>(message.size())) + message;
}
std::string bundle_head(const std::string& source) {
    return osc_string("#bundle") + osc_int(0) + osc_int(1) +
           osc_message(",ss", osc_string("source") + osc_string(source));
}
std::string alive(const std::vector<std::int32_t>& sessions) {
    std::string types = ",s", arguments = osc_string("alive");
    for (const std::int32_t session : sessions) {
        types += 'i';
        arguments += osc_int(session);
    }
    return osc_message(types, arguments);
}
std::string fseq(std::int32_t value) { return osc_message(",si", osc_string("fseq") + osc_int(value)); }

std::int32_t int_at(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
    return static_cast<std::int32_t>(value);
}
std::int32_t fseq_of(const std::string& datagram) { return int_at(datagram, datagram.size() - 4); }

constexpr const char* source = "kinectable@127.0.0.1";

std::unique_ptr<OscChannel> channel_to(const UdpReceiver& receiver) {
    return std::make_unique<UdpChannel>("127.0.0.1", receiver.port());
}

ReportedFinger finger(int id, ReportedPhase phase, double u, double v) {
    return {.id = id, .phase = phase, .camera_mm = {}, .surface = {u, v}, .height_mm = 0.0};
}

TEST(TuioSink, OneCursorIsTheGoldenDatagram) {
    const UdpReceiver receiver;
    TuioSink sink(channel_to(receiver), source);
    receiver.take_all();
    TouchReport report;
    report.touches = {finger(1, ReportedPhase::down, 0.25, 0.75)};
    sink.publish(report);
    const std::string datagram = receiver.take();
    ASSERT_THAT(datagram, SizeIs(188));
    // Session id and fseq follow the clock: taken from their places, the rest is checked byte for byte.
    const std::string head = bundle_head(source);
    const std::int32_t session = int_at(datagram, head.size() + alive({0}).size() - 4);
    EXPECT_EQ(datagram, head + alive({session}) +
                            osc_message(",sifffff", osc_string("set") + osc_int(session) + osc_float(0.25f) +
                                                        osc_float(0.75f) + osc_float(0.f) + osc_float(0.f) +
                                                        osc_float(0.f)) +
                            fseq(fseq_of(datagram)));
    EXPECT_GT(fseq_of(datagram), 0);
}

TEST(TuioSink, AHoveringFingerIsTheGoldenDatagramOf25Dcur) {
    const UdpReceiver receiver;
    TuioSink sink(channel_to(receiver), source, 100.0);
    receiver.take_all();
    TouchReport report;
    report.hovers = {{.id = 1, .surface = {0.25, 0.75}, .height_mm = 50.0}};
    sink.publish(report);
    const std::string datagram = receiver.take();
    const auto message = [](const std::string& types, const std::string& arguments) {
        return osc_message(types, arguments, "/tuio/25Dcur");
    };
    const std::string before_session = osc_string("#bundle") + osc_int(0) + osc_int(1) +
                                       message(",ss", osc_string("source") + osc_string(source)) +
                                       message(",si", osc_string("alive"));
    const std::int32_t session = int_at(datagram, before_session.size());
    std::string set = osc_string("set") + osc_int(session);
    for (const float number : {0.25f, 0.75f, 0.5f, 0.f, 0.f, 0.f, 0.f}) set += osc_float(number);
    EXPECT_EQ(datagram, osc_string("#bundle") + osc_int(0) + osc_int(1) +
                            message(",ss", osc_string("source") + osc_string(source)) +
                            message(",si", osc_string("alive") + osc_int(session)) +
                            message(",sifffffff", set) +
                            message(",si", osc_string("fseq") + osc_int(fseq_of(datagram))));
}

TEST(TuioSink, SaysTheEmptyTableAtStartAndTwiceAtTheEnd) {
    const UdpReceiver receiver;
    { const TuioSink sink(channel_to(receiver), source); }
    const auto datagrams = receiver.take_all();
    ASSERT_THAT(datagrams, SizeIs(5));
    for (const std::string& datagram : datagrams) {
        EXPECT_EQ(datagram, bundle_head(source) + alive({}) + fseq(fseq_of(datagram)));
    }
    EXPECT_EQ(fseq_of(datagrams[0]), -1);
    EXPECT_GT(fseq_of(datagrams[2]), fseq_of(datagrams[1]) + 100);
    EXPECT_EQ(fseq_of(datagrams[3]), fseq_of(datagrams[2]) + 1);
    EXPECT_EQ(fseq_of(datagrams[4]), -1);
}

TEST(TuioSink, ReleaseSaysTheEmptyTableTwice) {
    const UdpReceiver receiver;
    TuioSink sink(channel_to(receiver), source);
    receiver.take_all();
    sink.release_all();
    EXPECT_THAT(receiver.take_all(), SizeIs(2));
    sink.idle();
    EXPECT_THAT(receiver.take_all(), SizeIs(0)) << "nothing new to say within a second";
}

TEST(TuioSink, SplitsWhatDoesNotFitInADatagramAndRepeatsSourceAliveAndCount) {
    const UdpReceiver receiver;
    TuioSink sink(channel_to(receiver), source);
    receiver.take_all();
    TouchReport report;
    for (int id = 0; id < 50; ++id) report.touches.push_back(finger(id, ReportedPhase::down, id / 50.0, 0.5));
    sink.publish(report);
    const auto parts = receiver.take_all();
    ASSERT_THAT(parts, SizeIs(3));
    const std::string head = bundle_head(source);
    const std::string same_alive = parts[0].substr(head.size(), alive(std::vector<std::int32_t>(50)).size());
    std::size_t set_bytes = 0;
    for (const std::string& part : parts) {
        EXPECT_LE(part.size(), 1472u);
        EXPECT_THAT(part, StartsWith(head + same_alive));
        EXPECT_THAT(part, EndsWith(fseq(fseq_of(parts[0]))));
        set_bytes += part.size() - head.size() - same_alive.size() - fseq(0).size();
    }
    EXPECT_EQ(set_bytes, 50u * 56u) << "every cursor once, 56 bytes each";
}

TEST(TuioSink, TwentyTwoCursorsFitInOneDatagram) {
    const UdpReceiver receiver;
    TuioSink sink(channel_to(receiver), source);
    receiver.take_all();
    TouchReport report;
    for (int id = 0; id < 22; ++id) report.touches.push_back(finger(id, ReportedPhase::down, 0.5, 0.5));
    sink.publish(report);
    EXPECT_THAT(receiver.take_all(), SizeIs(1));
}

TEST(TuioSink, AReceiverThatIsNotThereIsNoErrorAndMayStartLater) {
    int port = 0;
    { port = UdpReceiver().port(); }
    TuioSink sink(std::make_unique<UdpChannel>("127.0.0.1", port), source);
    TouchReport report;
    report.touches = {finger(1, ReportedPhase::down, 0.5, 0.5)};
    for (int i = 0; i < 50; ++i) sink.publish(report);
    const UdpReceiver late(port);
    sink.publish(report);
    sink.publish(report);
    EXPECT_THAT(late.take(), testing::Not(testing::IsEmpty()));
}

TEST(UdpChannel, NamesAHostWithoutAddressAndAPortThatIsNone) {
    expect_error([] { UdpChannel("no such host", 3333); }, ExitStatus::configuration,
                 testing::HasSubstr("TUIO host no such host"));
    expect_error([] { UdpChannel("127.0.0.1", 70'000); }, ExitStatus::configuration,
                 testing::HasSubstr("TUIO port 70000"));
}

}  // namespace
}  // namespace touchstone
