#include "storage/results/catalogue/maintenance.hpp"

#include <gmock/gmock.h>

#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class MaintenanceTest : public ResultsTest {
 protected:
  [[nodiscard]] MaintenanceLog log() const { return MaintenanceLog(settings_for(*database)); }
  [[nodiscard]] std::string entered() const {
    return value("SELECT count(*) FROM loopscope.maintenance_event");
  }
};

MaintenanceEntry packing(const std::string& loop, int hours) {
  return {loop, slot(hours), "valve", "new packing"};
}

TEST_F(MaintenanceTest, WhatIsEnteredIsListed) {
  add_loops({"b", "a"});
  EXPECT_THAT(log().add(std::vector{packing("b", 2), packing("a", 3), packing("a", 1)}), IsEmpty());
  EXPECT_THAT(log().list().at(0).statement, HasSubstr("a running service judges it"));
  judge_repairs();
  const std::vector<MaintenanceRow> rows = log().list();
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].entry.loop_name, "a");
  EXPECT_EQ(rows[0].entry.done_at_us, slot(1));
  EXPECT_EQ(rows[0].entry.kind, "valve");
  EXPECT_EQ(rows[0].entry.description, "new packing");
  EXPECT_EQ(rows[1].entry.done_at_us, slot(3));
  EXPECT_FALSE(rows[0].word);
  EXPECT_THAT(rows[0].statement, HasSubstr("no usable window"));
  EXPECT_EQ(log().list("b").size(), 1u);
  EXPECT_THAT(log().list("c"), IsEmpty());
}

TEST_F(MaintenanceTest, WorkIsEnteredInSomebodysName) {
  add_loops({"a", "b"});
  MaintenanceEntry named = packing("a", 1);
  named.on_behalf_of = "J. Doe";
  EXPECT_THAT(log().add(std::vector{named, packing("b", 1)}), IsEmpty());
  const std::vector<MaintenanceRow> rows = log().list();
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].entry.on_behalf_of, "J. Doe");
  EXPECT_EQ(rows[1].entry.on_behalf_of, std::nullopt);
  EXPECT_EQ(rows[0].author, database->owner()) << "the login";
}

TEST_F(MaintenanceTest, OneBadEntryKeepsAllOut) {
  add_loops({"a"});
  const auto refused = log().add(std::vector{packing("a", 1), packing("x", 1)});
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_EQ(refused[0].place, 1u);
  EXPECT_EQ(refused[0].reason, MaintenanceRefusal::unknown_loop);
  EXPECT_EQ(entered(), "0");
}

TEST_F(MaintenanceTest, FutureAndRepetitionAreRefused) {
  add_loops({"a"});
  EXPECT_THAT(log().add(std::vector{packing("a", 1)}), IsEmpty());
  const auto refused = log().add(std::vector{packing("a", 24 * 365 * 100), packing("a", 1)});
  ASSERT_EQ(refused.size(), 2u);
  EXPECT_EQ(refused[0].reason, MaintenanceRefusal::in_future);
  EXPECT_EQ(refused[1].reason, MaintenanceRefusal::entered_already);
  EXPECT_EQ(entered(), "1");
}

TEST_F(MaintenanceTest, KindsAreThoseOfTheTable) {
  add_loops({"a"});
  for (const std::string& kind : maintenance_kinds())
    EXPECT_THAT(log().add(std::vector{MaintenanceEntry{"a", slot(1), kind, kind}}), IsEmpty());
  EXPECT_THROW(
      static_cast<void>(log().add(std::vector{MaintenanceEntry{"a", slot(1), "magic", "wand"}})),
      DatabaseError);
}

TEST_F(MaintenanceTest, WordsMayHoldAnyText) {
  const std::string odd = "'; DROP TABLE loopscope.loop; -- \"{,}\" °C";
  add_loops({odd});
  EXPECT_THAT(log().add(std::vector{MaintenanceEntry{odd, slot(1), "other", odd}}), IsEmpty());
  ASSERT_EQ(log().list(odd).size(), 1u);
  EXPECT_EQ(log().list(odd)[0].entry.description, odd);
}

TEST_F(MaintenanceTest, WhatIsGivenTwiceIsRefused) {
  add_loops({"a"});
  const auto refused = log().add(std::vector{packing("a", 1), packing("a", 2), packing("a", 1)});
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_EQ(refused[0].place, 2u);
  EXPECT_EQ(refused[0].reason, MaintenanceRefusal::entered_already);
  EXPECT_EQ(entered(), "0");
}

}  // namespace
}  // namespace loopscope::storage
