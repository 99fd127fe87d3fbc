#include <algorithm>
#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <thread>

#include "tests/end_to_end/plant.hpp"

namespace loopscope::tests {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

constexpr const char* kCount = "select count(*) from loopscope.analysis";
constexpr const char* kLocks =
    "from pg_locks join pg_database as d on d.oid = database where datname = current_database() "
    "and mode = 'AccessExclusiveLock' and granted and relation = 'loopscope.analysis'::regclass";

/// A daemon over a plant, started by run(); killed at the end if it still runs.
class Unattended : public testing::Test {
 protected:
  void SetUp() override { wait_for_hour_with(std::chrono::seconds(60)); }
  void run(const std::string& schedule = "", const std::string& daemon = R"("workers": 1)") {
    plant.write_settings(Plant::settings(R"("schedule": {"poll_s": 0.2, "settle_s": 0)" + schedule +
                                         R"(}, "daemon": {)" + daemon + "}"));
    daemon_.emplace(plant.command_line("run"), log_file());
  }
  std::string log_file() const { return plant.folder() / "daemon.log"; }
  std::string log() const { return content_of(log_file()); }
  /// Waits until `holds` does; false after 30 s.
  template <typename Holds>
  static bool comes(Holds holds) {
    for (int tries = 0; tries < 300; ++tries) {
      if (holds()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return false;
  }
  bool becomes(const std::string& query, const std::string& answer) const {
    return comes([&] { return plant.sql(query) == answer; });
  }
  bool logs(const std::string& words) const {
    return comes([&] { return log().find(words) != std::string::npos; });
  }
  /// Nothing can be written until unlock_results().
  void lock_results() {
    const std::string commands =
        "begin; lock table loopscope.analysis in access exclusive mode; select pg_sleep(600)";
    lock_.emplace(
        std::vector<std::string>{"/usr/bin/psql", "-X", "-d", plant.connection(), "-c", commands},
        plant.folder() / "lock.log");
    ASSERT_TRUE(becomes(std::string("select count(*) ") + kLocks, "1"));
  }
  void unlock_results() {
    plant.sql(std::string("select pg_terminate_backend(pid) ") + kLocks);
    ASSERT_TRUE(becomes(std::string("select count(*) ") + kLocks, "0"));
  }
  /// Exit code after SIGTERM.
  int stop() {
    daemon_->send(SIGTERM);
    return daemon_->wait(30);
  }

  Plant plant;
  std::optional<BackgroundProgram> daemon_;
  std::optional<BackgroundProgram> lock_;
};

TEST_F(Unattended, MissedSlotsAreMadeUpForAndOlderOnesLeftOut) {
  plant.import_loop("FIC101");
  // Twenty slots ago somebody worked for the last time.
  plant.sql(
      "update loopscope.loop set period_s = 100;"
      "update loopscope.schedule set visible_at = now(), last_slot_end = date_bin('100 s', now(), "
      "'epoch') - interval '2000 s'");
  run(R"(, "catch_up_slots": 5)");
  // The newest slot may pass while this runs.
  ASSERT_TRUE(comes([&] { return std::stoi(plant.sql(kCount)) >= 6; }));
  ASSERT_TRUE(becomes("select count(*) from loopscope.schedule where visible_at > now()", "1"));
  EXPECT_THAT(plant.sql(kCount), AnyOf("6", "7"));
  EXPECT_EQ(plant.sql("select extract(epoch from max(slot_end) - min(slot_end))::int / 100 + 1 - "
                      "count(*) from loopscope.analysis"),
            "0")
      << "one after the other, none left out";
  EXPECT_EQ(stop(), 0);
}

TEST_F(Unattended, ALoopThatWasLostTwiceIsTakenAloneAndForgivenWhenItIsDone) {
  for (unsigned seed = 1; seed <= 3; ++seed)
    plant.import_loop("loop " + std::to_string(seed), 600, seed);
  plant.sql("update loopscope.schedule set owner = 'gone', lost_leases = 2, visible_at = now()");
  run();
  ASSERT_TRUE(becomes(kCount, "3"));
  EXPECT_TRUE(becomes("select max(lost_leases), max(attempts) from loopscope.schedule", "0|0"));
  EXPECT_EQ(stop(), 0);
}

TEST_F(Unattended, ALoopThatWasLostAloneRests) {
  plant.import_loop("FIC101");
  plant.sql("update loopscope.schedule set owner = 'gone', lost_leases = 3, visible_at = now()");
  run();
  ASSERT_TRUE(becomes("select lost_leases from loopscope.schedule", "4"));
  EXPECT_EQ(plant.sql("select owner is null, visible_at > now() + interval '30 s', last_error "
                      "from loopscope.schedule"),
            "t|t|the lease of gone ended without a result, alone");
  EXPECT_EQ(stop(), 0);
  EXPECT_EQ(plant.sql(kCount), "0");
}

TEST_F(Unattended, OnceTakesWhatMayKillItAloneAndLast) {
  for (unsigned seed = 1; seed <= 3; ++seed)
    plant.import_loop("loop " + std::to_string(seed), 600, seed);
  plant.write_settings(Plant::settings(R"("schedule": {"settle_s": 0})"));
  // The first two have killed two workers and a third; the first one alone since.
  plant.sql(
      "update loopscope.schedule set owner = 'gone', visible_at = now(), lost_leases = 4 - loop_id"
      " where loop_id < 3");
  const ProgramResult once = plant.loopscope("once");
  EXPECT_EQ(once.exit_code, 0) << once.err;
  EXPECT_THAT(once.out, HasSubstr("1 more are held by other workers"));
  EXPECT_EQ(plant.sql("select string_agg(loop_id::text, ' ' order by analysis_id)"
                      " from loopscope.analysis"),
            "3 2");
  EXPECT_EQ(plant.sql("select loop_id, lost_leases from loopscope.schedule where lost_leases > 0"),
            "1|4");
}

TEST_F(Unattended, WhatIsHeldLongerThanALeaseStaysHeldWhileWorkGoesOn) {
  for (unsigned seed = 1; seed <= 4; ++seed)
    plant.import_loop("loop " + std::to_string(seed), 600, seed);
  // Nothing can be written for longer than a lease; what is done waits and is written once.
  lock_results();
  run(R"(, "lease_s": 10)");
  // Of four that are due at once a first claim may take fewer (ClaimWatermark); the others wait for
  // the batches that cannot be written.
  ASSERT_TRUE(becomes("select count(*) > 0 from loopscope.schedule where owner is not null", "t"));
  std::this_thread::sleep_for(std::chrono::seconds(12));
  unlock_results();
  EXPECT_TRUE(
      becomes("select count(*) from loopscope.schedule where last_slot_end is not null", "4"));
  EXPECT_EQ(plant.sql("select max(fence), max(lost_leases) from loopscope.schedule"), "1|0");
  EXPECT_EQ(plant.sql(kCount), "4");
  EXPECT_EQ(stop(), 0);
}

TEST_F(Unattended, ResultsThatAreRefusedGoBackWithoutBlame) {
  for (unsigned seed = 1; seed <= 2; ++seed)
    plant.import_loop("loop " + std::to_string(seed), 600, seed);
  plant.sql(
      "create function refuse() returns trigger language plpgsql as $$ begin raise exception 'not "
      "today'; end $$; create trigger refuse before insert on loopscope.analysis for each row "
      "execute function refuse()");
  run();
  ASSERT_TRUE(
      becomes("select count(*) from loopscope.schedule where last_error like "
              "'%not today%' and owner is null and attempts = 0 and lost_leases = 0 and "
              "visible_at > now() + interval '30 s'",
              "2"));
  // Not by dropping the trigger: that locks the table and its partitions while the daemon uses
  // them.
  plant.sql(
      "create or replace function refuse() returns trigger language plpgsql as $$ begin return "
      "new; end $$");
  plant.sql("update loopscope.schedule set visible_at = now()");
  EXPECT_TRUE(becomes(kCount, "2"));
  EXPECT_TRUE(logs("results database: works again"));
  EXPECT_EQ(stop(), 0);
}

TEST_F(Unattended, ASecondSignalEndsItAtOnce) {
  plant.import_loop("FIC101");
  lock_results();
  run();
  ASSERT_TRUE(becomes("select count(*) from loopscope.schedule where owner is not null", "1"));
  daemon_->send(SIGTERM);
  ASSERT_TRUE(logs("stopping: finishing what is in hand"));
  daemon_->send(SIGTERM);
  EXPECT_EQ(daemon_->wait(5), 128 + SIGTERM);
  EXPECT_THAT(log(), HasSubstr("stopped at once by a second signal"));
}

TEST_F(Unattended, ThePagesTellOfLifeReadinessAndFigures) {
  plant.import_loop("FIC101");
  run("", R"("http_address": "127.0.0.1:0")");
  ASSERT_TRUE(becomes(kCount, "1"));
  const std::string words = "health, metrics and pages: http://127.0.0.1:";
  ASSERT_TRUE(logs(words));
  const std::string text = log();
  const std::string port = std::to_string(std::stoi(text.substr(text.find(words) + words.size())));
  const auto page = [&](const std::string& path) {
    return run_program({"/bin/bash", "-c",
                        "exec 3<>/dev/tcp/127.0.0.1/" + port + "; printf 'GET " + path +
                            " HTTP/1.1\\r\\nHost: localhost\\r\\n\\r\\n' >&3; cat <&3"})
        .out;
  };
  EXPECT_THAT(page("/livez"), HasSubstr("200 OK"));
  EXPECT_TRUE(comes([&] { return page("/readyz").find("200 OK") != std::string::npos; }));
  EXPECT_TRUE(comes([&] {
    return page("/metrics").find("loopscope_loops_total{result=\"new\"} 1") != std::string::npos;
  }));
  EXPECT_THAT(page("/metrics"), HasSubstr("loopscope_lag_seconds"));
  EXPECT_EQ(stop(), 0);
}

}  // namespace
}  // namespace loopscope::tests
