#include <gmock/gmock.h>

#include "storage/results/schema/migrate.hpp"
#include "tests/storage/results/upgrade_fixture.hpp"

/// What a migration makes of the list of a filled schema.
namespace loopscope::storage {
namespace {

using testing::IsEmpty;
using ListUpgradeTest = UpgradeTest;

/// A filled schema 21: what was weighed stays, nothing is combined, and the list goes by the
/// window.
TEST_F(ListUpgradeTest, WindowsOfSchema21StayAndAreListedByTheirOwnProbability) {
  tests::TestDatabase other;
  const std::string login = fill_former_schema(other, 21);
  other.execute("UPDATE loopscope.verdict SET cause_probabilities = '{0.01,0.9}'");
  other.execute("UPDATE loopscope.annotation SET withdrawn_at = now() WHERE withdrawn_at IS NULL");
  const std::string rows =
      "SELECT row(loop_id, slot_end, algorithm_revision, input_revision, code, confidence,"
      " cause_probabilities)::text FROM loopscope.verdict ORDER BY 1";
  const TextRows verdicts = other.rows(rows);
  migrate(settings_for(other, login));
  EXPECT_EQ(other.rows(rows), verdicts);
  EXPECT_EQ(other.rows("SELECT count(*), count(combined_probabilities), count(combined_evidence)"
                       " FROM loopscope.analysis"),
            (TextRows{{"2", "0", "0"}}));
  EXPECT_EQ(other.rows("SELECT loop_name, combined_confidence, round(fault_probability::numeric, 2)"
                       " FROM loopscope.flagged_loop"),
            (TextRows{{"a", "NULL", "0.99"}}))
      << "loop b has not been given back: no newest slot";
  EXPECT_EQ(other.value("SELECT count(*) FROM pg_attribute WHERE attname = 'combined_windows' AND"
                        " col_description(attrelid, attnum) IS NULL"),
            "0");
}

/// A filled schema 22 with a loop on its list: the stay goes on, and leaves at the looser rate.
TEST_F(ListUpgradeTest, StaysOfSchema22GoOn) {
  tests::TestDatabase other;
  const std::string login = fill_former_schema(other, 22);
  other.execute("UPDATE loopscope.verdict SET cause_probabilities = '{0.01,0.9}'");
  other.execute(kStay);
  const std::string notices = "SELECT row(notice.*)::text FROM loopscope.flag_notice AS notice";
  const TextRows before_it = other.rows(notices);
  migrate(settings_for(other, login));
  EXPECT_EQ(other.rows(notices), before_it);
  EXPECT_EQ(other.rows("SELECT loop_name, area, owner FROM loopscope.flagged_loop ORDER BY 1"),
            (TextRows{{"a", "NULL", "NULL"}, {"b", "NULL", "NULL"}}));
  other.execute("UPDATE loopscope.verdict SET cause_probabilities = '{0.15,0.8}'");
  EXPECT_EQ(other.rows("SELECT loop_name FROM loopscope.flagged_loop"), (TextRows{{"a"}}));
  EXPECT_EQ(other.rows("SELECT loop_name, hidden_by FROM loopscope.hidden_loop"),
            (TextRows{{"b", "probability"}}));
  EXPECT_EQ(other.value("SELECT count(*) FROM loopscope.service_factor"), "0")
      << "nobody looked at modes before";
  EXPECT_EQ(other.rows("SELECT count(*), count(control_fraction) FROM loopscope.analysis"),
            (TextRows{{"2", "0"}}));
}

/// A filled schema 24 with a loop on its list: the stay goes on with a probability that no loop
/// enters with any more.
TEST_F(ListUpgradeTest, StaysOfSchema24GoOn) {
  tests::TestDatabase other;
  const std::string login = fill_former_schema(other, 24);
  other.execute(kStay);
  other.execute(
      "UPDATE loopscope.verdict SET cause_probabilities = '{0.25,0.75}';"
      "UPDATE loopscope.parameter SET value = 0.3"
      " WHERE name IN ('list_false_share', 'list_leave_share')");
  const std::string list = "SELECT loop_name FROM loopscope.flagged_loop ORDER BY 1";
  EXPECT_EQ(other.rows(list), (TextRows{{"a"}, {"b"}}));
  migrate(settings_for(other, login));
  EXPECT_EQ(other.rows(list), (TextRows{{"a"}}));
  EXPECT_EQ(other.rows("SELECT loop_name, hidden_by, reason FROM loopscope.hidden_loop"),
            (TextRows{{"b", "probability", "not sure enough for the list (probability 0.75)"}}));
}

/// A filled schema 25 with a loop on its list that is more likely sound than faulty: it leaves.
TEST_F(ListUpgradeTest, WhoeverIsSoundLeavesTheListOfSchema25) {
  tests::TestDatabase other;
  const std::string login = fill_former_schema(other, 25);
  other.execute(kStay);
  other.execute(
      "UPDATE loopscope.verdict SET cause_probabilities = '{0.55,0.45}';"
      "UPDATE loopscope.parameter SET value = 0.6"
      " WHERE name IN ('list_false_share', 'list_leave_share')");
  const std::string list = "SELECT loop_name FROM loopscope.flagged_loop";
  EXPECT_EQ(other.rows(list), (TextRows{{"a"}}));
  migrate(settings_for(other, login));
  EXPECT_THAT(other.rows(list), IsEmpty());
  EXPECT_EQ(other.value("SELECT hidden_by FROM loopscope.hidden_loop WHERE loop_name = 'a'"),
            "probability");
}

}  // namespace
}  // namespace loopscope::storage
