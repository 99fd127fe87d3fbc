#include <gtest/gtest.h>
#include <sstream>

#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/setup/choose_layout.hpp"
#include "tests/historians/truth.hpp"
#include "tests/historians/vendor.hpp"

namespace loopscope::tests {
namespace {

/// The tables of each vendor, seen by a login that nobody told anything.
class Recognise : public testing::TestWithParam<Vendor> {
 protected:
  void SetUp() override {
    if (!test_server()) GTEST_SKIP() << kNoServer;
  }
};

TEST_P(Recognise, WhatASiteWouldHaveToSay) {
  const TestDatabase database;
  const Truth truth(database, 2, 400);
  database.execute(GetParam().tables);
  database.execute("DROP TABLE truth");
  const config::HistorianSettings expected = settings_of(GetParam(), database.conninfo());
  storage::HistorianSurvey survey(daemon::historian_connection(expected));
  std::istringstream nobody;
  std::ostringstream said;
  daemon::Questions questions(nobody, said, false);
  daemon::LayoutCandidate layout = daemon::choose_layout(survey.tables(), {}, questions);
  EXPECT_TRUE(layout.readable);
  EXPECT_TRUE(daemon::look_at_rows(survey, "", questions, layout).empty());
  layout.historian.name = expected.name;
  layout.historian.connection = expected.connection;
  EXPECT_EQ(layout.historian.table, expected.table);
  EXPECT_EQ(layout.historian.tag_column, expected.tag_column);
  EXPECT_EQ(layout.historian.quality_rule, expected.quality_rule);
  EXPECT_TRUE(layout.historian == expected) << layout.seen;
}

INSTANTIATE_TEST_SUITE_P(Vendors, Recognise, testing::ValuesIn(vendors()),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace loopscope::tests
