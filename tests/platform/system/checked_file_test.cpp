#include "platform/system/checked_file.hpp"

#include <cstring>
#include <fstream>
#include <random>
#include <xxhash.h>

#include "platform/system/atomic_file.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr FileFormat format{"sample", {'S', 'A', 'M', 'P', 'L', 'E', '0', '1'}, 3, 1'000'000};

class CheckedFile : public testing::Test {
  protected:
    std::string bytes() const {
        std::ifstream file(path_, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    void put(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }
    /// With a checksum that is right.
    void put_sealed(std::string bytes) const {
        XXH3_state_t* state = XXH3_createState();
        XXH3_64bits_reset(state);
        XXH3_64bits_update(state, bytes.data(), 32);
        XXH3_64bits_update(state, bytes.data() + 40, bytes.size() - 40);
        const std::uint64_t sum = XXH3_64bits_digest(state);
        XXH3_freeState(state);
        std::memcpy(bytes.data() + 32, &sum, 8);
        put(bytes);
    }
    void expect_refused(const testing::Matcher<std::string>& why) const {
        expect_error([&] { (void)read_checked_file(path_, format); }, ExitStatus::bad_data,
                     AllOf(HasSubstr(path_.string()), why));
    }

    TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "a.sample";
};

/// Half noise, half zeros: some of it compresses.
std::string some_content(std::size_t size) {
    std::mt19937 random(1);
    std::string content(size, '\0');
    for (std::size_t i = 0; i < size / 2; ++i) content[i] = static_cast<char>(random());
    return content;
}

TEST_F(CheckedFile, GivesBackWhatWasWritten) {
    for (const std::size_t size : {0u, 1u, 1000u, 1'000'000u}) {
        write_checked_file(path_, format, some_content(size));
        EXPECT_EQ(read_checked_file(path_, format), some_content(size));
    }
    EXPECT_LT(bytes().size(), 510'000u) << "the zeros were not compressed";
}

TEST_F(CheckedFile, MissingFilesAndFoldersCannotBeOpened) {
    for (const std::filesystem::path& path : {folder_ / "not there", folder_.path()}) {
        expect_error([&] { (void)read_checked_file(path, format); }, ExitStatus::no_input,
                     AllOf(HasSubstr(path.string()), HasSubstr("cannot be opened")));
    }
}

TEST_F(CheckedFile, OtherKindsOfFile) {
    for (const std::string& text : {std::string(), std::string("PLY"), std::string(100, 'x')}) {
        put(text);
        expect_refused(HasSubstr("is not a sample"));
    }
}

TEST_F(CheckedFile, OtherVersions) {
    write_checked_file(path_, format, "content");
    std::string newer = bytes(), older = bytes();
    newer[8] = 4;
    older[8] = 2;
    put_sealed(newer);
    expect_refused(AllOf(HasSubstr("a newer version"), HasSubstr("format 4"), HasSubstr("read is 3")));
    put_sealed(older);
    expect_refused(AllOf(HasSubstr("an older version"), HasSubstr("format 2")));
}

TEST_F(CheckedFile, EveryFlippedBitIsNoticed) {
    write_checked_file(path_, format, some_content(40));
    const std::string whole = bytes();
    for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
        std::string flipped = whole;
        flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
        put(flipped);
        expect_refused(testing::_);
        if (HasFailure()) FAIL() << "bit " << bit;
    }
}

TEST_F(CheckedFile, EveryTruncationIsNoticedAndSoIsMore) {
    write_checked_file(path_, format, some_content(40));
    const std::string whole = bytes();
    for (std::size_t size = 8; size < whole.size(); ++size) {
        put(whole.substr(0, size));
        expect_refused(HasSubstr("cut short"));
    }
    put(whole + '\0');
    expect_refused(HasSubstr("longer"));
}

TEST_F(CheckedFile, SizesThatAreNotTrueTakeNoMemory) {
    write_checked_file(path_, format, some_content(200));
    const std::string whole = bytes();
    for (const std::uint64_t claimed :
         {std::uint64_t{1} << 62, ~std::uint64_t{0}, std::uint64_t{1'000'001}}) {
        std::string bytes = whole;
        std::memcpy(bytes.data() + 16, &claimed, 8);
        put_sealed(bytes);
        expect_refused(HasSubstr("more than a sample can have"));
    }
    for (const std::uint64_t claimed : {0u, 199u, 201u, 1'000'000u}) {
        std::string bytes = whole;
        std::memcpy(bytes.data() + 16, &claimed, 8);
        put_sealed(bytes);
        expect_refused(HasSubstr("damaged (size)"));
    }
    put_sealed(whole.substr(0, 24) + std::string("\x0a\0\0\0\0\0\0\0", 8) + std::string(8, '\0') +
               "not a zstd");
    expect_refused(HasSubstr("damaged (size)"));
}

TEST_F(CheckedFile, ADamagedOneCostsTheLastContentOnly) {
    write_checked_file(path_, format, "first");
    write_checked_file(path_, format, "second");
    const std::string whole = bytes();
    std::string flipped = whole;
    flipped.back() = static_cast<char>(flipped.back() ^ 1);
    for (const std::string& damaged : {std::string(), whole.substr(0, 30), flipped}) {
        put(damaged);
        EXPECT_EQ(read_checked_file(path_, format), "first");
    }
    write_checked_file(path_, format, "third");
    put(flipped);
    EXPECT_EQ(read_checked_file(path_, format), "first") << "a damaged file took the place of a whole one";
}

TEST_F(CheckedFile, BothDamagedNameTheNewest) {
    write_checked_file(path_, format, "first");
    write_checked_file(path_, format, "second");
    put(bytes() + '\0');
    std::ofstream(previous_of(path_)) << "nothing";
    expect_refused(HasSubstr("longer"));
}

/// An older program may want it again.
TEST_F(CheckedFile, OneOfAnotherVersionIsKept) {
    write_checked_file(path_, FileFormat{format.name, format.magic, 2, format.max_content_bytes},
                       "of before");
    write_checked_file(path_, format, "of now");
    std::filesystem::rename(previous_of(path_), path_);
    expect_refused(HasSubstr("an older version"));
}

TEST_F(CheckedFile, OneThatWasTakenAwayDoesNotComeBack) {
    write_checked_file(path_, format, "first");
    write_checked_file(path_, format, "second");
    std::filesystem::remove(path_);
    expect_error([&] { (void)read_checked_file(path_, format); }, ExitStatus::no_input, testing::_);
    write_checked_file(path_, format, "third");
    put("");
    expect_refused(testing::_);
}

TEST_F(CheckedFile, ACacheKeepsNoPreviousOne) {
    write_checked_cache(path_, format, "first");
    write_checked_cache(path_, format, "second");
    EXPECT_EQ(read_checked_file(path_, format), "second");
    EXPECT_FALSE(std::filesystem::exists(previous_of(path_)));
}

TEST_F(CheckedFile, WhereItCannotBeWritten) {
    expect_error([&] { write_checked_file("/nowhere/a.sample", format, "x"); }, ExitStatus::io_error,
                 HasSubstr("/nowhere/a.sample"));
}

}  // namespace
}  // namespace touchstone
