#include "platform/camera/recording_check.hpp"

#include <cstring>
#include <fstream>

#include "tests/platform/camera/camera_fixtures.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/small_recording.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class RecordingCheck : public testing::Test {
  protected:
    void expect_refused(const std::string& bytes, const std::string& why) const {
        std::ofstream(path_, std::ios::binary) << bytes;
        expect_error([&] { check_recording(path_.string()); }, ExitStatus::bad_data,
                     AllOf(HasSubstr(path_.string()), HasSubstr(why)));
    }
    /// The small recording with a number in the place of another.
    static std::string with(std::size_t at, std::uint32_t value) {
        std::string bytes = test::small_recording();
        std::memcpy(bytes.data() + at, &value, sizeof value);
        return bytes;
    }

    TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "table.oni";
};

constexpr std::size_t file_header = 24, type_in_record = 4, node_in_record = 8, fields_in_record = 12,
                      payload_in_record = 16, record_header = 28;

TEST_F(RecordingCheck, TakesAWholeOne) {
    for (const test::ListAt list : {test::ListAt::before_end, test::ListAt::after_end}) {
        std::ofstream(path_, std::ios::binary) << test::small_recording(list);
        check_recording(path_.string());
    }
}

/// Streams begin within one another, and are removed before their lists of pictures.
TEST_F(RecordingCheck, TakesWhatOpenNisRecorderWrites) {
    for (const bool color : {false, true}) {
        write_sequence(folder_, 5, true);
        {
            DepthCamera camera = DepthCamera::open(sequence_uri(folder_), Pace::step, color);
            camera.start_recording(path_.string());
            ASSERT_EQ(read_to_end(camera).size(), 5u);
        }
        check_recording(path_.string());
    }
}

TEST_F(RecordingCheck, TakesOneOfARealSensor) {
    const std::string real = TOUCHSTONE_SHARED_DIR "/data/openni-desk/Captured.oni";
    if (!std::filesystem::exists(real)) GTEST_SKIP() << "no " << real;
    check_recording(real);
}

TEST_F(RecordingCheck, MissingOnes) {
    for (const std::filesystem::path& path : {folder_ / "none.oni", folder_.path()})
        expect_error([&] { check_recording(path.string()); }, ExitStatus::no_input, HasSubstr(path.string()));
}

TEST_F(RecordingCheck, OtherFilesAndVersions) {
    expect_refused("PNG or something else that is longer", "not an OpenNI recording");
    expect_refused(with(4, 0x0002'0101), "version");
}

TEST_F(RecordingCheck, EveryTruncation) {
    for (const test::ListAt list : {test::ListAt::before_end, test::ListAt::after_end}) {
        const std::string whole = test::small_recording(list);
        for (std::size_t size = 4; size < whole.size(); ++size)
            expect_refused(whole.substr(0, size), "cut short");
    }
}

/// What makes OpenNI's player write past its buffers, wait for ever or take all memory.
TEST_F(RecordingCheck, SizesAndNumbersThatCannotBe) {
    const std::size_t property = file_header + record_header + 4 + 6 + 4 + 4 + 20 + 8;
    expect_refused(with(20, 0xffff'fffe), "more streams");
    expect_refused(with(file_header, 7), "should be a record");
    expect_refused(with(file_header + type_in_record, 99), "should be a record");
    expect_refused(with(file_header + node_in_record, 2), "stream that there is not");
    expect_refused(with(file_header + fields_in_record, 27), "a size that none can have");
    expect_refused(with(file_header + fields_in_record, 0x7fff'ffff), "a size that none can have");
    expect_refused(with(file_header + payload_in_record, 8), "what it cannot");
    expect_refused(with(file_header + record_header, 0xffff'ffff), "name");
    expect_refused(with(file_header + record_header, 3), "name");
    expect_refused(with(file_header + record_header + 14, 0x12345678), "packed in an unknown way");
    expect_refused(with(file_header + record_header + 18, 0x7fff'ffff), "more pictures");
    expect_refused(with(property + record_header + 14, 4), "property has a size");
    expect_refused(with(12, 50'000), "after its end");
}

}  // namespace
}  // namespace touchstone
