#include "platform/camera/openni_error.hpp"

#include <gtest/gtest.h>

#include "platform/openni2_drivers/common/driver_properties.h"

namespace touchstone {
namespace {

TEST(OpenniError, FindsADriversErrorAmongOthers) {
    const auto error =
        driver_error_in("Device: something\n\t" TOUCHSTONE_ERROR_PREFIX
                        "66 no folder /a b; say seq:DIR" TOUCHSTONE_ERROR_SUFFIX "\n\tDeviceOpen failed");
    ASSERT_TRUE(error);
    EXPECT_EQ(error->status(), ExitStatus::no_input);
    EXPECT_STREQ(error->what(), "no folder /a b; say seq:DIR");
}

TEST(OpenniError, ATextCutShortIsStillAnError) {
    const auto error = driver_error_in(TOUCHSTONE_ERROR_PREFIX "65 cut he");
    ASSERT_TRUE(error);
    EXPECT_EQ(error->status(), ExitStatus::bad_data);
    EXPECT_STREQ(error->what(), "cut he");
}

TEST(OpenniError, OtherTextsAreNone) {
    EXPECT_FALSE(driver_error_in(""));
    EXPECT_FALSE(driver_error_in("Couldn't open device 'x'"));
    EXPECT_FALSE(driver_error_in(TOUCHSTONE_ERROR_PREFIX "?"));
}

TEST(OpenniError, OneLine) { EXPECT_EQ(one_line("\n\t a\n\tb  c \n"), "a b c"); }

}  // namespace
}  // namespace touchstone
