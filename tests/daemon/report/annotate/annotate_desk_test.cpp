#include "daemon/report/annotate/annotate_desk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

/// With a database the desk is tested end to end (annotate_test). Here nothing may be asked of one.
TEST(AnnotateDesk, WithoutALoginOfItsOwnItNeverTakesTheOwners) {
  config::Settings off, no_login;
  off.results.connection = no_login.results.connection = "host=/nowhere";
  off.results.engineer_connection = "host=/nowhere user=engineer";
  no_login.daemon.acknowledge.trusted_proxies = {"127.0.0.1"};
  for (const config::Settings& settings : {off, no_login}) {
    int written = 0;
    AnnotateDesk desk([&] { return std::make_shared<const config::Settings>(settings); },
                      [&] { ++written; });
    EXPECT_EQ(desk.show({"anna", "127.0.0.1"}, "FIC101").status, 404);
    const HttpAnswer answer =
        desk.take({"anna", "127.0.0.1"}, "name=FIC101&deed=acknowledge&reason=x");
    EXPECT_EQ(answer.status, 404);
    EXPECT_THAT(answer.body, testing::HasSubstr("nothing was entered"));
    EXPECT_EQ(written, 0);
  }
}

}  // namespace
}  // namespace loopscope::daemon
