#include "tests/support/pooler.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>

#include "tests/end_to_end/plant.hpp"

namespace loopscope::tests {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A plant whose program reaches both of its databases by way of a PgBouncer.
class ThroughPooler : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_pooler()) GTEST_SKIP() << kNoPooler;
    plant.import_loop("FIC101");
  }
  void start(const std::string& mode, const std::string& more = "") {
    pooler.emplace(mode, std::vector<std::string>{"postgres", make_owner(plant.connection())},
                   more);
    const std::string through = pooler->conninfo(plant.connection());
    const std::string as_owner = with_key(through, "user", make_owner(plant.connection()));
    plant.write_settings(R"({"results": {"connection": ")" + as_owner +
                         R"("}, "historians": [{"name": "plant", "connection": ")" + through +
                         R"("}]})");
  }

  Plant plant;
  std::optional<Pooler> pooler;
};

TEST_F(ThroughPooler, SessionModeWorks) {
  start("session");
  const ProgramResult checked = plant.loopscope("check-config");
  EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
  const ProgramResult once = plant.loopscope("once");
  EXPECT_EQ(once.exit_code, 0) << once.err;
  EXPECT_EQ(plant.sql("select count(*) from loopscope.analysis"), "1");
}

TEST_F(ThroughPooler, TransactionModeIsRefusedByEveryCommand) {
  start("transaction", "ignore_startup_parameters = options\n");
  for (const char* command : {"check-config", "once"}) {
    const ProgramResult refused = plant.loopscope(command);
    EXPECT_EQ(refused.exit_code, 4) << command << refused.out;
    EXPECT_THAT(refused.out + refused.err,
                AllOf(HasSubstr("another client was given the same session"), HasSubstr("HINT: "),
                      HasSubstr("pool_mode = session")))
        << command;
  }
  const std::string checked = plant.loopscope("check-config").out;
  EXPECT_THAT(checked, AllOf(HasSubstr("PROBLEM  results database: "),
                             HasSubstr("PROBLEM  historian plant: ")))
      << "each of the two is told";
  EXPECT_EQ(plant.sql("select count(*) from loopscope.analysis"), "0");
}

TEST_F(ThroughPooler, AHistorianAloneBehindTransactionModeIsAway) {
  start("transaction", "ignore_startup_parameters = options\n");
  plant.write_settings(R"({"results": {"connection": "@RESULTS@"}, "historians": [{"name": "plant",
      "connection": ")" +
                       pooler->conninfo(plant.connection()) + R"("}]})");
  const ProgramResult once = plant.loopscope("once");
  EXPECT_NE(once.exit_code, 0) << once.out;
  EXPECT_THAT(once.out + once.err,
              AllOf(HasSubstr("historian plant"), HasSubstr("pool_mode = session")));
  EXPECT_EQ(plant.sql("select count(*) from loopscope.analysis"), "0");
}

}  // namespace
}  // namespace loopscope::tests
