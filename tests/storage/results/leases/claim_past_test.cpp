#include <gmock/gmock.h>

#include "storage/results/results_database.hpp"
#include "tests/storage/results/results_fixture.hpp"

/// Claims for slots of the past, beside the work on the newest ones.
namespace loopscope::storage {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

constexpr double kLease_s = 100.0;
constexpr double kReserve_s = 30.0;
constexpr const char* kAtWork =
    "INSERT INTO loopscope.worker (worker, program_version, algorithm_revision, held_loops,"
    " lost_leases) VALUES ('host/1', '0.1.0', 1, 0, 0)";
/// All that a claim and its end must leave alone.
constexpr const char* kSchedule =
    "SELECT visible_at, owner, attempts, lost_leases, last_error, last_slot_end, result_slot_end,"
    " pv_flat_s, pv_step FROM loopscope.schedule ORDER BY loop_id";

class ClaimPastTest : public ResultsTest {
 protected:
  void SetUp() override {
    ResultsTest::SetUp();
    if (!database) return;
    add_loops({"a"});
    results.emplace(connect());
  }
  std::vector<ClaimedLoop> claim(int hours) {
    const auto loop_id = std::stoll(value("SELECT loop_id FROM loopscope.loop"));
    const std::vector<std::pair<std::int64_t, std::int64_t>> wish{{loop_id, slot(hours)}};
    return results->claim_past("host/2/0", kLease_s, kReserve_s, wish);
  }
  CompletedLoop judged(int hours, const std::string& digest) {
    const ClaimedLoop claimed = claim(hours).at(0);
    CompletedLoop done = completed(claimed, slot(hours), digest);
    done.kept_due_us = claimed.kept_due_us();
    return done;
  }
  void due_in(const std::string& span) const {
    database->execute("UPDATE loopscope.schedule SET visible_at = now() + interval '" + span + "'");
  }
  std::optional<ResultsDatabase> results;
};

TEST_F(ClaimPastTest, LeavesTheScheduleAsItWas) {
  results->finish(std::vector{completed(claim_all(*results).at(0), slot(9), "newest")}, {});
  due_in("1 hour");
  const TextRows before = database->rows(kSchedule);
  const CompletedLoop past = judged(3, "past");
  EXPECT_NE(database->rows(kSchedule), before) << "it is held meanwhile";
  EXPECT_EQ(results->finish(std::vector{past}, {}).inserted, 1U);
  EXPECT_EQ(database->rows(kSchedule), before);
  EXPECT_EQ(results->finish(std::vector{past}, {}).unchanged, 1U) << "after a commit in doubt";
  EXPECT_EQ(database->rows(kSchedule), before);
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.analysis"), "2");
}

TEST_F(ClaimPastTest, WhatFailsIsNoFailureOfTheLoop) {
  due_in("1 hour");
  const TextRows before = database->rows(kSchedule);
  const ClaimedLoop claimed = claim(3).at(0);
  const FailedLoop failed{claimed.loop.loop_id, claimed.fence, "no", 60.0, true,
                          claimed.kept_due_us()};
  EXPECT_EQ(results->finish({}, std::vector{failed}).failed, 1U);
  EXPECT_EQ(database->rows(kSchedule), before);
}

TEST_F(ClaimPastTest, EndsWhenTheLoopFallsDue) {
  due_in("50 seconds");
  const std::string due = value("SELECT visible_at FROM loopscope.schedule");
  EXPECT_THAT(claim(3), SizeIs(1));
  EXPECT_EQ(value("SELECT visible_at FROM loopscope.schedule"), due);
  results->release_owned("host/2/0");
  due_in("1 day");
  EXPECT_THAT(claim(3), SizeIs(1));
  EXPECT_EQ(value("SELECT visible_at = now() FROM loopscope.schedule"), "f");
  EXPECT_EQ(value("SELECT visible_at <= now() + interval '100 seconds' FROM loopscope.schedule"),
            "t");
}

TEST_F(ClaimPastTest, WhoeverDoesTheNewestSlotsGoesFirst) {
  database->execute(kAtWork);
  EXPECT_THAT(claim(3), IsEmpty()) << "due now";
  due_in("20 seconds");
  EXPECT_THAT(claim(3), IsEmpty()) << "due within the reserve";
  database->execute("UPDATE loopscope.loop SET period_s = 20");
  EXPECT_THAT(claim(3), SizeIs(1)) << "of a short period no more than its half is asked for";
  due_in("-1 seconds");
  EXPECT_THAT(claim_all(*results), SizeIs(1)) << "taken over in time";
  EXPECT_THAT(claim(3), IsEmpty()) << "held";
}

TEST_F(ClaimPastTest, WhereNobodyDoesTheNewestSlotsDueLoopsAreTaken) {
  const TextRows before = database->rows(kSchedule);
  results->finish(std::vector{judged(3, "past")}, {});
  EXPECT_EQ(database->rows(kSchedule), before) << "still due";
  database->execute(kAtWork);
  database->execute("UPDATE loopscope.worker SET last_seen = now() - interval '101 seconds'");
  EXPECT_THAT(claim(3), SizeIs(1)) << "its lease would be over";
}

TEST_F(ClaimPastTest, NoDisabledLoopAndNoSuspect) {
  database->execute("UPDATE loopscope.schedule SET lost_leases = 3");
  EXPECT_THAT(claim(3), IsEmpty());
  database->execute("UPDATE loopscope.schedule SET lost_leases = 0");
  Catalogue(settings_for(*database)).set_enabled(std::vector<std::string>{"a"}, false);
  EXPECT_THAT(claim(3), IsEmpty());
}

TEST_F(ClaimPastTest, WhoLostItsClaimWritesNothing) {
  due_in("1 hour");
  const CompletedLoop late = judged(3, "past");
  database->execute(kEndLeases);
  EXPECT_THAT(claim_all(*results), SizeIs(1));
  const WriteCount count = results->finish(std::vector{late}, {});
  EXPECT_EQ(count.fenced_off, 1U);
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.analysis"), "0");
}

/// What goes from window to window is that of the slot before, whatever was judged since.
TEST_F(ClaimPastTest, BringsWhatWasKnownByThen) {
  due_in("1 hour");
  EXPECT_FALSE(claim(3).at(0).pv_past);
  results->release_owned("host/2/0");
  due_in("1 hour");
  const auto judge = [&](int hours, core::diagnosis::VerdictCode code, double flat_s) {
    CompletedLoop done = judged(hours, "d" + std::to_string(hours));
    done.record->diagnosis.verdict.code = code;
    done.record->diagnosis.evidence.pv_past = {flat_s, 0.5};
    results->finish(std::vector{done}, {});
  };
  using enum core::diagnosis::VerdictCode;
  judge(9, healthy, 90.0);
  judge(3, tight_tuning, 30.0);
  judge(5, valve_stiction, 50.0);
  const ClaimedLoop next = claim(6).at(0);
  ASSERT_TRUE(next.pv_past && next.last_verdict && next.past);
  EXPECT_EQ(next.pv_past->longest_flat_s, 50.0);
  EXPECT_EQ(next.pv_past->step, 0.5);
  EXPECT_EQ(next.last_verdict->code, valve_stiction);
  EXPECT_EQ(next.past->end_us, slot(6));
  results->release_owned("host/2/0");
  due_in("1 hour");
  EXPECT_FALSE(claim(3).at(0).last_verdict) << "the slot itself is not before itself";
}

TEST_F(ClaimPastTest, ProblemsOfTheDataStayThoseOfTheNewestSlot) {
  CompletedLoop newest = completed(claim_all(*results).at(0), slot(9), "newest");
  newest.problems = {{"dead_tag", "op", slot(8), std::nullopt}};
  results->finish(std::vector{newest}, {});
  due_in("1 hour");
  const std::string problems = "SELECT row(p.*)::text FROM loopscope.standing_problem AS p";
  const TextRows before = database->rows(problems);
  results->finish(std::vector{judged(3, "past")}, {});
  EXPECT_EQ(database->rows(problems), before);
  EXPECT_EQ(value("SELECT slot_end FROM loopscope.latest_verdict"), "2026-01-01 09:00:00+00");
}

}  // namespace
}  // namespace loopscope::storage
