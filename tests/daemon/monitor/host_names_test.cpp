#include "daemon/monitor/host_names.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

TEST(HostNames, AddressesAndLocalhostNeedNoEntry) {
  const HostNames none;
  for (const char* host : {"127.0.0.1", "127.0.0.1:9470", "10.1.2.3", "0.0.0.0:80", "[::1]",
                           "[::1]:9470", "[2001:db8::5]:1", "[::ffff:10.0.0.1]", "localhost",
                           "localhost:9470", "LocalHost", "localhost.", "localhost:"})
    EXPECT_TRUE(none.contain(host)) << host;
}

TEST(HostNames, NobodyElseIsMeant) {
  const HostNames none;
  for (const char* host : {"",
                           ":9470",
                           ".",
                           "evil.example",
                           "evil.example:9470",
                           "localhost.evil.example",
                           "127.0.0.1.evil.example",
                           "evil-localhost",
                           "127.0.0.1@evil.example",
                           "[::1",
                           "::1",
                           "[::1].evil.example",
                           "[::1]:evil",
                           "[evil]",
                           "[127.0.0.1]",
                           "127.1",
                           "0x7f000001",
                           "2130706433",
                           "127.0.0.1:9470:1",
                           "127.0.0.1:x",
                           "localhost evil.example",
                           "999.1.1.1"})
    EXPECT_FALSE(none.contain(host)) << host;
}

TEST(HostNames, EnteredNamesAreServedUnderAnyPortAndCase) {
  const HostNames names({"Loopscope.Plant.example", "scada"});
  for (const char* host : {"loopscope.plant.example", "LOOPSCOPE.plant.EXAMPLE:443",
                           "loopscope.plant.example.", "scada:9470", "127.0.0.1"})
    EXPECT_TRUE(names.contain(host)) << host;
  for (const char* host : {"plant.example", "x.scada", "scada.plant.example", "scada2"})
    EXPECT_FALSE(names.contain(host)) << host;
}

}  // namespace
}  // namespace loopscope::daemon
