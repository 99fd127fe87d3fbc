#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <thread>

#include "tests/end_to_end/plant.hpp"

namespace loopscope::tests {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A row of FIC101.PV so many seconds after the newest one.
constexpr const char* kNextRow =
    "insert into history select tag, time + interval '@ seconds', value + 0.1, quality from "
    "history "
    "where tag = 'FIC101.PV' order by time desc limit 1";
constexpr const char* kChangeInTheMiddle =
    "update history set value = value + 3 where tag = 'FIC101.PV' and time = "
    "(select max(time) - interval '1500 seconds' from history)";

std::string with_number(std::string text, const std::string& number) {
  return text.replace(text.find('@'), 1, number);
}

/// A plant with one loop of 600 samples, the last of them half an hour ago, a slot each 10 minutes.
class LateData : public testing::Test {
 protected:
  void import() const {
    plant.import_loop("FIC101", 600);
    plant.sql(
        "update history set time = time + (select date_bin('10 minutes', now() - interval '25 "
        "minutes', 'epoch') - max(time) from history)");
    ASSERT_EQ(plant.loopscope("loops", {"set", "FIC101", "--period-s", "600"}).exit_code, 0);
  }
  std::string once() const {
    const ProgramResult pass = plant.loopscope("once");
    EXPECT_EQ(pass.exit_code, 0) << pass.err;
    return pass.out;
  }
  Plant plant;
};

TEST_F(LateData, ALateRowRevisesTheEarlierSlotAsWellOnceAndVisibly) {
  import();
  EXPECT_THAT(once(), HasSubstr("1 new"));
  for (int k = 0; k < 60; ++k) plant.sql(with_number(kNextRow, "10"));
  EXPECT_THAT(once(), HasSubstr("1 new, 0 revised"));
  EXPECT_EQ(plant.sql("select count(*) from loopscope.analysis"), "2");
  EXPECT_EQ(plant.sql("select count(*) from loopscope.revised_verdict"), "0");

  plant.sql(kChangeInTheMiddle);
  EXPECT_THAT(once(), HasSubstr("0 new, 1 revised, 0 unchanged, 0 failed, 1 earlier window"));
  EXPECT_EQ(plant.sql("select count(*), min(input_revision), max(input_revision) "
                      "from loopscope.analysis"),
            "2|2|2");
  EXPECT_EQ(plant.sql("select count(*), count(former_code), bool_and(revised_at > "
                      "former_decided_at) from loopscope.revised_verdict"),
            "2|2|t");
  EXPECT_EQ(plant.sql("select count(*) from loopscope.verdict"), "4") << "former verdicts stay";
  const std::string stamps =
      "select string_agg(analysed_at::text, ' ' order by slot_end) from loopscope.analysis";
  const std::string before = plant.sql(stamps);
  EXPECT_THAT(once(), HasSubstr("0 new, 0 revised, 1 unchanged"));
  EXPECT_EQ(plant.sql(stamps), before) << "a further pass changes nothing";
}

TEST_F(LateData, WithoutAHorizonEarlierSlotsStayAsTheyAre) {
  import();
  plant.write_settings(Plant::settings(R"("schedule": {"revise_slots": 0})"));
  once();
  for (int k = 0; k < 60; ++k) plant.sql(with_number(kNextRow, "10"));
  once();
  plant.sql(kChangeInTheMiddle);
  EXPECT_THAT(once(), Not(HasSubstr("earlier")));
  EXPECT_EQ(plant.sql("select count(*) from loopscope.revised_verdict"), "1");
}

TEST_F(LateData, OtherSettingsAreNoLateRows) {
  import();
  once();
  for (int k = 0; k < 60; ++k) plant.sql(with_number(kNextRow, "10"));
  once();
  plant.write_settings(Plant::settings(R"("analysis": {"fit_model": false})"));
  EXPECT_THAT(once(), HasSubstr("1 revised"));
  EXPECT_EQ(plant.sql("select string_agg(input_revision::text, ' ' order by slot_end) "
                      "from loopscope.analysis"),
            "1 2")
      << "the earlier slot keeps what it was judged by";
}

TEST_F(LateData, TheDaemonNoticesRowsThatComeAfterTheirSlot) {
  import();
  plant.write_settings(
      Plant::settings(R"("schedule": {"poll_s": 0.2, "settle_s": 0, "whole_read_every": 3})"));
  ASSERT_EQ(plant.loopscope("loops", {"set", "FIC101", "--period-s", "2"}).exit_code, 0);
  BackgroundProgram daemon(plant.command_line("run"), plant.folder() / "daemon.log");
  const auto becomes_true = [&](const std::string& query) {
    for (int tries = 0; tries < 300 && plant.sql(query) != "t"; ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return plant.sql(query);
  };
  ASSERT_EQ(becomes_true("select count(*) > 0 from loopscope.analysis"), "t");
  plant.sql(kChangeInTheMiddle);
  EXPECT_EQ(becomes_true("select count(*) = 1 from loopscope.revised_verdict"), "t");
  // The next slots come, the late row is no news any more.
  const std::string slots = plant.sql("select count(*) + 2 from loopscope.analysis");
  EXPECT_EQ(becomes_true("select count(*) >= " + slots + " from loopscope.analysis"), "t");
  EXPECT_EQ(plant.sql("select count(*), max(input_revision) from loopscope.revised_verdict"),
            "1|2");
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(20), 0);
}

TEST_F(LateData, NothingNewerThanTheSettlingTimeAndNothingFromTheFutureIsRead) {
  import();
  plant.write_settings(Plant::settings(R"("schedule": {"settle_s": 600})"));
  once();
  const std::string first = plant.sql("select input_digest from loopscope.analysis");
  plant.sql(
      "insert into history values ('FIC101.PV', now() + interval '1 day', 99999, 192), "
      "('FIC101.OP', now() + interval '40 years', 1, 192)");
  EXPECT_THAT(once(), HasSubstr("1 unchanged")) << "a row of the future ends no slot";
  EXPECT_EQ(plant.sql("select string_agg(role || ' ' || tag || ' ' || figure, ', ' order by role) "
                      "from loopscope.data_problem where problem = 'future_rows'"),
            "op FIC101.OP 1, pv FIC101.PV 1");

  plant.sql("insert into history values ('FIC101.PV', now() - interval '60 seconds', 99999, 192)");
  EXPECT_THAT(once(), HasSubstr("1 new")) << "data go on, so the newest settled slot is due";
  EXPECT_EQ(plant.sql("select max(window_end) <= now() - interval '600 seconds', "
                      "max(slot_end) <= now() - interval '600 seconds', "
                      "count(distinct input_digest) from loopscope.analysis"),
            "t|t|2");
  EXPECT_EQ(plant.sql("select max(error_std) < 100 from loopscope.analysis"), "t");
  EXPECT_EQ(plant.sql("select input_digest from loopscope.analysis order by slot_end limit 1"),
            first);
}

TEST_F(LateData, ATagThatHasStoppedIsSaidWithTheTimeOfItsLastRow) {
  import();
  plant.sql("update history set time = time - interval '3 days'");
  once();
  const std::string dead =
      "select dead_roles, dead_tags, dead_since[1] = (select max(time) from history where "
      "tag = "
      "'FIC101.PV') from loopscope.monitor_health";
  EXPECT_EQ(plant.sql(dead), "{op,pv}|{FIC101.OP,FIC101.PV}|t");
  plant.sql("update history set time = time + interval '3 days'");
  once();
  EXPECT_EQ(plant.sql("select dead_tags is null from loopscope.monitor_health"), "t");
}

TEST_F(LateData, MostlyBadQualityIsSaidBesideTheVerdict) {
  import();
  plant.sql(
      "update history set quality = 0 where tag = 'FIC101.PV' and "
      "extract(epoch from time)::bigint % 100 >= 30");
  EXPECT_THAT(once(), HasSubstr("1 could not be judged"));
  EXPECT_EQ(plant.sql("select problem, role, tag, judged, figure from loopscope.data_problem "
                      "where problem in ('bad_quality', 'insufficient_data') order by 1"),
            "bad_quality|pv|FIC101.PV|f|0.7\ninsufficient_data|pv|FIC101.PV|f|");
}

TEST_F(LateData, DeadTagsAndLoopsThatCannotBeJudgedAreSaid) {
  import();
  ASSERT_EQ(plant.loopscope("loops", {"set", "FIC101", "--mv-tag", "FIC101.ZT"}).exit_code, 0);
  ASSERT_EQ(plant.loopscope("loops", {"add", "ghost", "--pv-tag", "NOWHERE"}).exit_code, 0);
  EXPECT_THAT(once(), HasSubstr("1 could not be judged (loopscope.data_problem)"));
  EXPECT_EQ(plant.sql("select loop_name, role, tag, judged from loopscope.data_problem "
                      "where problem = 'no_rows' order by loop_name"),
            "FIC101|mv|FIC101.ZT|t\nghost|pv|NOWHERE|f");
  EXPECT_EQ(plant.sql("select dead_tags from loopscope.monitor_health where loop_name = 'FIC101'"),
            "{FIC101.ZT}");
  EXPECT_THAT(once(), HasSubstr("1 could not be judged")) << "said again, though nothing changed";
}

}  // namespace
}  // namespace loopscope::tests
