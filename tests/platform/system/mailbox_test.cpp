#include "platform/system/mailbox.hpp"

#include <gtest/gtest.h>
#include <memory>
#include <numeric>
#include <thread>
#include <vector>

namespace touchstone {
namespace {

using std::chrono::milliseconds;
using Numbers = std::vector<int>;

Numbers joined(Numbers&& untaken, Numbers&& newer) {
    untaken.insert(untaken.end(), newer.begin(), newer.end());
    return std::move(untaken);
}

TEST(Mailbox, GivesTheLatestValueOnce) {
    Mailbox<int> box;
    box.put(1);
    box.put(2);
    EXPECT_EQ(box.try_take(), 2);
    EXPECT_EQ(box.try_take(), std::nullopt);
}

TEST(Mailbox, MergesAValueThatWasNotTaken) {
    Mailbox<Numbers> box(joined);
    box.put({1, 2});
    box.put({3});
    EXPECT_EQ(box.take(), (Numbers{1, 2, 3}));
    box.put({4});
    EXPECT_EQ(box.take(), (Numbers{4}));
}

TEST(Mailbox, TakesValuesThatCannotBeCopied) {
    Mailbox<std::unique_ptr<int>> box;
    box.put(std::make_unique<int>(5));
    EXPECT_EQ(**box.take(), 5);
}

TEST(Mailbox, WaitsNoLongerThanAsked) {
    Mailbox<int> box;
    EXPECT_EQ(box.take_for(milliseconds(1)), std::nullopt);
    box.put(3);
    EXPECT_EQ(box.take_for(milliseconds(1)), 3);
}

TEST(Mailbox, ClosedGivesWhatIsInsideThenNothing) {
    Mailbox<int> box;
    box.put(1);
    EXPECT_FALSE(box.closed());
    box.close();
    box.put(2);
    EXPECT_TRUE(box.closed());
    EXPECT_EQ(box.take(), 1);
    EXPECT_EQ(box.take(), std::nullopt);
}

TEST(Mailbox, CloseWakesAThreadThatWaits) {
    Mailbox<int> box;
    std::optional<int> taken = 1;
    std::thread taker([&] { taken = box.take(); });
    box.close();
    taker.join();
    EXPECT_EQ(taken, std::nullopt);
}

TEST(Mailbox, LosesNothingBetweenTwoThreadsWhenValuesAreMerged) {
    constexpr int count = 20'000;
    Mailbox<Numbers> box(joined);
    Numbers taken;
    std::thread taker([&] {
        while (const std::optional<Numbers> some = box.take()) {
            taken.insert(taken.end(), some->begin(), some->end());
        }
    });
    for (int i = 0; i < count; ++i) box.put({i});
    box.close();
    taker.join();
    Numbers expected(count);
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(taken, expected);
}

}  // namespace
}  // namespace touchstone
