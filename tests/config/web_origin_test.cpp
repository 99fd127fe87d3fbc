#include "config/web_origin.hpp"

#include <gtest/gtest.h>

namespace loopscope::config::tests {
namespace {

TEST(WebOrigin, IsWhatBrowsersSend) {
  for (const char* text :
       {"https://loopscope.plant.example", "http://scada:8080", "http://10.1.2.3",
        "https://[fd00::1]:8443", "http://[::1]", "http://127.0.0.1:9470"})
    EXPECT_TRUE(is_web_origin(text)) << text;
}

TEST(WebOrigin, AnythingElseWouldNeverBeEqual) {
  for (const char* text :
       {"", "null", "https://", "loopscope.plant.example", "https://Loopscope.example",
        "https://a.example/", "https://a.example/pages", "https://a.example:443", "http://a:80",
        "https://u@a.example", "https://a.example:0", "https://a.example:08443", "https://a:x",
        "https://a:", "ftp://a", "https://*.example", "https://a.example ", "https://[::1", "*"})
    EXPECT_FALSE(is_web_origin(text)) << text;
}

}  // namespace
}  // namespace loopscope::config::tests
