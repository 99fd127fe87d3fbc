#include "config/host_name.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "tests/config/settings_text.hpp"

namespace loopscope::config::tests {
namespace {

using testing::ElementsAre;

TEST(HostName, IsLabelsBetweenDots) {
  for (const char* name : {"loopscope", "Loopscope.Plant.Example", "worker-1.plant", "a_b",
                           "xn--bcher-kva.example", "10.0.0.5", "1"})
    EXPECT_TRUE(is_host_name(name)) << name;
  for (const char* text :
       {"", ".", "a.", ".a", "a..b", "http://a", "a:9470", "a/b", "*.plant", "[::1]", "::1", "a b",
        "b\xc3\xbc"
        "cher",
        "a,b", "a\n"})
    EXPECT_FALSE(is_host_name(text)) << text;
  EXPECT_FALSE(is_host_name(std::string("a\0b", 3)));
}

TEST(HostName, IsNoLongerThanNameServersTake) {
  const std::string label(63, 'a');
  EXPECT_TRUE(is_host_name(label));
  EXPECT_FALSE(is_host_name(label + "a"));
  EXPECT_TRUE(is_host_name(label + "." + label + "." + label + "." + std::string(61, 'a')));
  EXPECT_FALSE(is_host_name(label + "." + label + "." + label + "." + std::string(62, 'a')));
}

TEST(HostName, SettingsRefuseWhatIsNone) {
  const auto with = [](const std::string& names) {
    return lines_of(minimal_with(R"("daemon": {"http_names": )" + names + "}"));
  };
  EXPECT_THAT(with(R"(["loopscope.plant.example", "scada"])"), testing::IsEmpty());
  EXPECT_THAT(with(R"(["scada", "http://scada:9470/"])"),
              ElementsAre("/daemon/http_names/1: is not a host name"));
}

}  // namespace
}  // namespace loopscope::config::tests
