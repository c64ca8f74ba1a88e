#include "platform/output/contact_follower.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

namespace touchstone {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr auto down = ReportedPhase::down;
constexpr auto move = ReportedPhase::move;
constexpr auto up = ReportedPhase::up;

/// Changes as words: "begin 7".
std::vector<std::string> words(const std::vector<ContactChange>& changes) {
    std::vector<std::string> said;
    for (const ContactChange& change : changes) {
        const char* step = change.step == ContactStep::begin  ? "begin "
                           : change.step == ContactStep::move ? "move "
                                                              : "end ";
        said.push_back(step + std::to_string(change.contact));
    }
    return said;
}

ReportedFinger finger(int id, ReportedPhase phase) { return {.id = id, .phase = phase}; }

TEST(ContactFollower, AContactBeginsMovesAndEnds) {
    ContactFollower contacts(7);
    EXPECT_THAT(words(contacts.take({finger(3, down)})), ElementsAre("begin 7"));
    EXPECT_THAT(words(contacts.take({finger(3, move)})), ElementsAre("move 7"));
    EXPECT_THAT(words(contacts.take({finger(3, up)})), ElementsAre("end 7"));
    EXPECT_THAT(words(contacts.take({finger(3, down)})), ElementsAre("begin 8"));
}

TEST(ContactFollower, WhatAReportLeavesOutHasEnded) {
    ContactFollower contacts(1);
    contacts.take({finger(1, down), finger(2, down)});
    EXPECT_THAT(words(contacts.take({finger(2, move)})), ElementsAre("move 2", "end 1"));
    EXPECT_THAT(words(contacts.end_all()), ElementsAre("end 2"));
    EXPECT_THAT(words(contacts.end_all()), IsEmpty());
}

TEST(ContactFollower, AnUpAndADownOfOneFingerInOneReportAreTwoContacts) {
    ContactFollower contacts(1);
    contacts.take({finger(1, down)});
    EXPECT_THAT(words(contacts.take({finger(1, up), finger(1, down)})), ElementsAre("end 1", "begin 2"));
    EXPECT_THAT(words(contacts.take({finger(1, down), finger(1, up)})),
                ElementsAre("end 2", "begin 3", "end 3"));
}

TEST(ContactFollower, AMoveWithoutADownBeginsAndAnUpWithoutOneIsNothing) {
    ContactFollower contacts(1);
    EXPECT_THAT(words(contacts.take({finger(5, move), finger(6, up)})), ElementsAre("begin 1"));
}

TEST(ContactFollower, NumbersStayAboveZero) {
    ContactFollower contacts(std::numeric_limits<std::int32_t>::max());
    EXPECT_THAT(words(contacts.take({finger(1, down), finger(2, down)})),
                ElementsAre("begin 2147483647", "begin 1"));
}

}  // namespace
}  // namespace touchstone
