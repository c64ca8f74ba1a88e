#include "platform/output/web_origin.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

TEST(WebOrigin, ProgramsAndPagesOfThisMachineMayListen) {
    for (const char* origin : {"", "http://localhost", "http://localhost:8000", "https://127.0.0.1:8443",
                               "http://[::1]:8000", "http://[::1]"})
        EXPECT_TRUE(may_listen(origin, "")) << origin;
}

TEST(WebOrigin, OtherPagesMayNot) {
    for (const char* origin :
         {"https://example.com", "http://localhost.example.com", "http://127.0.0.1.example.com", "null",
          "localhost", "http://", "http://[::1", "http://[::1].example.com", "https://localhost@example.com",
          "http://notlocalhost:80", "*"})
        EXPECT_FALSE(may_listen(origin, "")) << origin;
}

TEST(WebOrigin, OneOriginOrAllCanBeAllowed) {
    EXPECT_TRUE(may_listen("https://kiosk.example:8443", "https://kiosk.example:8443"));
    EXPECT_FALSE(may_listen("https://kiosk.example", "https://kiosk.example:8443"));
    EXPECT_FALSE(may_listen("http://kiosk.example:8443", "https://kiosk.example:8443"));
    EXPECT_TRUE(may_listen("http://localhost:8000", "https://kiosk.example:8443"));
    EXPECT_TRUE(may_listen("https://example.com", "*"));
    EXPECT_TRUE(may_listen("null", "*"));
}

}  // namespace
}  // namespace touchstone
