#include <gmock/gmock.h>

#include "storage/results/catalogue/annotations.hpp"
#include "storage/results/reports/report_database.hpp"
#include "tests/storage/results/views_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

/// What the report says of findings that people took off the list, and of what they can mend.
class ReportOfPeopleTest : public ViewsTest {
 protected:
  [[nodiscard]] ReportDatabase report() const { return ReportDatabase(settings_for(*database)); }
};

TEST_F(ReportOfPeopleTest, FindingsTakenOffTheListAreToldNewestFirst) {
  tell({{.loop = "a"}, {.loop = "b"}, {.loop = "fine", .code = kHealthy}});
  EXPECT_THAT(report().counts(0).newest_annotations, SizeIs(0));
  Annotations people(settings_for(*database));
  people.add({"a", "acknowledged", "valve_stiction", {}, "ordered", "", 0, "J. Doe"});
  people.add({"fine", "false_positive", "tight_tuning", {}, "", "", 0});
  const std::int64_t until_us = report().now_us() + 3'600'000'000;
  people.add({"b", "suppressed", {}, until_us, "shutdown", "", 0});
  const PlantCounts counts = report().counts(0);
  EXPECT_EQ(counts.annotations, 2) << "what hides no fault is not told";
  ASSERT_THAT(counts.newest_annotations, SizeIs(2));
  const HiddenLoopRow& b = counts.newest_annotations[0];
  const HiddenLoopRow& a = counts.newest_annotations[1];
  EXPECT_EQ(b.loop_name + ": " + b.said.hidden_by + ", " + b.said.reason,
            "b: suppressed, shutdown");
  EXPECT_EQ(b.said.until_us, until_us);
  EXPECT_EQ(a.loop_name + ": " + a.code + ", " + a.said.reason, "a: valve_stiction, ordered");
  EXPECT_EQ(a.said.on_behalf_of, "J. Doe");
  EXPECT_EQ(a.said.author, value("SELECT max(author) FROM loopscope.annotation"));
}

TEST_F(ReportOfPeopleTest, OfManyFindingsTheOthersAreCounted) {
  tell({{.loop = "a"}});
  database->execute(
      "INSERT INTO loopscope.annotation (loop_id, kind) SELECT loop_id, 'false_positive'"
      " FROM loopscope.loop, generate_series(1, 32)");
  const PlantCounts counts = report().counts(0);
  EXPECT_EQ(counts.annotations, 32);
  EXPECT_THAT(counts.newest_annotations, SizeIs(30));
}

TEST_F(ReportOfPeopleTest, WhatNobodyCanMendIsNoProblem) {
  tell({{.loop = "a"}});
  database->execute("UPDATE loopscope.analysis SET flags = '{heavy_tails,sp_missing}'");
  const std::int64_t loop_id = std::stoll(value("SELECT loop_id FROM loopscope.loop"));
  std::vector<std::string> codes;
  for (const DataProblemRow& problem : report().data_problems(loop_id))
    codes.push_back(problem.code);
  EXPECT_THAT(codes, ElementsAre("sp_missing"));
}

}  // namespace
}  // namespace loopscope::storage
