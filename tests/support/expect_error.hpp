#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "platform/system/error.hpp"

namespace touchstone {

/// Runs f, which must throw Error of this status with a one-line message that matches.
template <class F>
void expect_error(F f, ExitStatus status, const ::testing::Matcher<std::string>& message) {
    try {
        f();
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), status) << error.what();
        EXPECT_THAT(std::string(error.what()), message);
        EXPECT_THAT(std::string(error.what()), ::testing::Not(::testing::HasSubstr("\n")));
        return;
    }
    ADD_FAILURE() << "no Error was thrown";
}

}  // namespace touchstone
