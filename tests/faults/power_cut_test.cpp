// The power goes, or the disk fails, between any two things that a save asks of the disk.
#include <cerrno>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>

#include "platform/system/atomic_file.hpp"
#include "platform/system/error.hpp"
#include "tests/faults/disk_recorder.hpp"
#include "tests/faults/kept_things.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using namespace test;

/// What a start finds; nothing where it has to do without.
std::optional<int> found_by_start(const KeptThing& thing, const std::filesystem::path& path) {
    try {
        return thing.load(path);
    } catch (const Error&) {
        return std::nullopt;
    }
}

/// What one save asks of the disk, and what lies there before it.
struct RecordedSave {
    DiskContent before;
    std::vector<DiskCall> calls;
};

RecordedSave record_save(const KeptThing& thing, const std::filesystem::path& folder, int number) {
    const DiskContent before = content_of_folder(folder);
    const DiskRecorder recorder(folder);
    thing.save(folder / thing.name, number);
    return {before, recorder.calls()};
}

class PowerCut : public testing::TestWithParam<KeptThing> {
  protected:
    TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / GetParam().name;
    std::mt19937 random_{20};
};

/// Each save begins on what a power cut in the one before it has left. Old or new, never a third, and the
/// next save works.
TEST_P(PowerCut, LeavesTheOldOrTheNewStateAndNeverAThird) {
    const KeptThing& thing = GetParam();
    const int cuts = times(200, 2500);
    std::optional<int> old_number;
    int cut = 0;
    for (int number = 1; cut < cuts; ++number) {
        const RecordedSave save = record_save(thing, folder_.path(), number);
        EXPECT_EQ(found_by_start(thing, path_), number);
        for (std::size_t made = 0; made <= save.calls.size(); ++made, ++cut) {
            put_content(folder_.path(), after_power_cut(save.before, save.calls, made, random_));
            const std::optional<int> found = found_by_start(thing, path_);
            const bool had_returned = made == save.calls.size();
            ASSERT_TRUE(found == number || (found == old_number && !had_returned))
                << "cut after call " << made << " of save " << number;
        }
        // Go on from a random cut.
        const std::size_t made = random_() % (save.calls.size() + 1);
        put_content(folder_.path(), after_power_cut(save.before, save.calls, made, random_));
        old_number = found_by_start(thing, path_);
    }
    RecordProperty("cuts", cut);
    std::printf("%d power cuts while %s was saved\n", cut, thing.name.c_str());
}

/// A disk without room, read-only, or broken, at every single call.
TEST_P(PowerCut, ADiskThatFailsLeavesTheOldStateAndAnErrorThatNamesTheFile) {
    const KeptThing& thing = GetParam();
    for (const int code : {ENOSPC, EROFS, EIO, EDQUOT}) {
        for (int call = 0;; ++call) {
            put_content(folder_.path(), {});
            thing.save(path_, 1);
            thing.save(path_, 2);
            DiskRecorder recorder(folder_.path());
            recorder.fail_at(call, code);
            std::optional<int> saved = 3;
            try {
                thing.save(path_, 3);
            } catch (const Error& error) {
                EXPECT_EQ(error.status(), ExitStatus::io_error);
                EXPECT_THAT(error.what(), testing::HasSubstr(path_.string()));
                saved.reset();
            }
            if (!recorder.has_failed()) break;
            const std::optional<int> found = found_by_start(thing, path_);
            EXPECT_TRUE(saved ? found == 3 : found == 2 || found == 3) << "call " << call;
            EXPECT_FALSE(std::filesystem::exists(path_.string() + ".new")) << "call " << call;
        }
    }
}

/// The disk, not a power cut, has damaged the newest file.
TEST_P(PowerCut, ADamagedFileCostsTheLastSaveOnly) {
    const KeptThing& thing = GetParam();
    thing.save(path_, 1);
    thing.save(path_, 2);
    const DiskContent whole = content_of_folder(folder_.path());
    const std::string newest = whole.at(thing.name);
    std::string flipped = newest;
    flipped[newest.size() / 2] = static_cast<char>(flipped[newest.size() / 2] ^ 1);
    if (!thing.is_checked) flipped = "\x01" + newest;
    for (const std::string& damaged : {std::string(), flipped, newest.substr(0, newest.size() / 2),
                                       std::string(newest.size(), '\0'), std::string("{ nonsense")}) {
        DiskContent content = whole;
        content[thing.name] = damaged;
        put_content(folder_.path(), content);
        if (!damaged.starts_with('{')) {
            EXPECT_EQ(found_by_start(thing, path_), 1);
        }
        thing.save(path_, 3);
        EXPECT_EQ(found_by_start(thing, path_), 3);
        std::filesystem::resize_file(path_, 20);
        EXPECT_EQ(found_by_start(thing, path_), 1) << "a damaged file has pushed out the good one before it";
    }
}

TEST_P(PowerCut, AFileThatWasTakenAwayStaysAway) {
    const KeptThing& thing = GetParam();
    thing.save(path_, 1);
    thing.save(path_, 2);
    std::filesystem::remove(path_);
    EXPECT_EQ(found_by_start(thing, path_), std::nullopt);
    thing.save(path_, 3);
    std::filesystem::resize_file(path_, 20);
    EXPECT_EQ(found_by_start(thing, path_), std::nullopt) << "the one that was given up came back";
}

INSTANTIATE_TEST_SUITE_P(Saves, PowerCut, testing::ValuesIn(kept_things()), [](const auto& thing) {
    std::string name = thing.param.name;
    std::erase(name, '.');
    return name;
});

/// The recorder itself: what is not flushed may be lost, torn or there.
TEST(DiskRecorder, KnowsWhatIsNotOnTheDiskYet) {
    const TemporaryFolder folder;
    const DiskRecorder recorder(folder.path());
    write_file_atomically(folder / "a", std::string(3000, 'x'));
    using Kind = DiskCall::Kind;
    std::vector<Kind> kinds;
    for (const DiskCall& call : recorder.calls()) kinds.push_back(call.kind);
    ASSERT_EQ(kinds, (std::vector{Kind::create, Kind::write, Kind::flush, Kind::rename, Kind::flush_folder}));
    std::mt19937 random(1);
    bool lost = false, torn = false, whole = false;
    for (int i = 0; i < 200; ++i) {
        const DiskContent after = after_power_cut({}, recorder.calls(), 2, random);
        lost = lost || after.empty();
        torn = torn || (after.contains("a.new") && after.at("a.new") != std::string(3000, 'x'));
        whole = whole || (after.contains("a.new") && after.at("a.new") == std::string(3000, 'x'));
        EXPECT_FALSE(after.contains("a"));
        EXPECT_EQ(after_power_cut({}, recorder.calls(), 5, random),
                  (DiskContent{{"a", std::string(3000, 'x')}}));
    }
    EXPECT_TRUE(lost && torn && whole);
}

}  // namespace
}  // namespace touchstone
