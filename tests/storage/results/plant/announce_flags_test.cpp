#include "storage/results/plant/announce_flags.hpp"

#include <gmock/gmock.h>
#include <libpq-fe.h>
#include <nlohmann/json.hpp>
#include <thread>

#include "storage/results/plant/plant_rounds.hpp"
#include "storage/results/session/session.hpp"
#include "tests/storage/results/views_fixture.hpp"

namespace loopscope::storage {
namespace {

using core::diagnosis::VerdictCode;
using testing::IsEmpty;
using testing::SizeIs;

/// Somebody who listens, as a hook does.
class Listener {
 public:
  explicit Listener(const std::string& conninfo) : connection_(PQconnectdb(conninfo.c_str())) {
    PQclear(PQexec(connection_, "LISTEN loopscope_flagged; LISTEN loopscope_confirmed"));
  }
  ~Listener() { PQfinish(connection_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  /// Channel and message of everything that has come; a question brings what waits on the way.
  [[nodiscard]] TextRows heard() const {
    PQclear(PQexec(connection_, "SELECT 1"));
    TextRows messages;
    while (PGnotify* message = PQnotifies(connection_)) {
      messages.push_back({message->relname, message->extra});
      PQfreemem(message);
    }
    return messages;
  }

 private:
  PGconn* connection_;
};

class AnnounceFlagsTest : public ViewsTest {
 protected:
  FlagAnnouncement announce() const {
    return PlantRounds(settings_for(*database)).announce_flags();
  }
  [[nodiscard]] TextRows history() const {
    return database->rows(
        "SELECT loop_name, code, status, stands, ended_by, announced FROM loopscope.flag_history"
        " ORDER BY flag_notice_id");
  }
};

TEST_F(AnnounceFlagsTest, TellsOfEachFlagOnce) {
  const Listener listener(database->conninfo());
  tell({{.loop = "a"}, {.loop = "fine", .code = VerdictCode::healthy}});
  EXPECT_THAT(announce().flagged, SizeIs(1));
  const TextRows heard = listener.heard();
  ASSERT_THAT(heard, SizeIs(1));
  EXPECT_EQ(heard[0][0], "loopscope_flagged");
  const auto message = nlohmann::json::parse(heard[0][1]);
  EXPECT_EQ(message["loop"], "a");
  EXPECT_EQ(message["code"], "valve_stiction");
  EXPECT_EQ(message["status"], "watch");
  EXPECT_EQ(message["confidence"], 1.0);
  EXPECT_EQ(message["rank"], 1);
  EXPECT_EQ(message["slot_end"], "2026-01-01T01:00:00Z");
  EXPECT_EQ(message["since"], "2026-01-01T01:00:00Z");
  EXPECT_EQ(message["summary"], "The valve sticks.");
  EXPECT_EQ(message["action"], "Stroke it.");
  tell({{.loop = "a", .slot_hours = 2}});
  EXPECT_THAT(announce().flagged, IsEmpty());
  EXPECT_THAT(listener.heard(), IsEmpty());
  EXPECT_EQ(history(), (TextRows{{"a", "valve_stiction", "watch", "t", "NULL", "t"}}));
}

/// Anybody who may connect can fill the queue of messages; here the right to send one is missing.
TEST_F(AnnounceFlagsTest, WhatListenersCannotBeToldIsNotedAllTheSame) {
  database->execute("REVOKE EXECUTE ON FUNCTION pg_notify(text, text) FROM PUBLIC");
  tell({{.loop = "a"}});
  const FlagAnnouncement untold = announce();
  EXPECT_THAT(untold.flagged, SizeIs(1));
  EXPECT_TRUE(untold.untold);
  EXPECT_EQ(history(), (TextRows{{"a", "valve_stiction", "watch", "t", "NULL", "t"}}));
  EXPECT_THAT(announce().flagged, IsEmpty());
}

TEST_F(AnnounceFlagsTest, TellsWhenAFlagIsConfirmed) {
  const Listener listener(database->conninfo());
  tell({{.loop = "a", .slot_hours = 1}});
  static_cast<void>(announce());
  tell({{.loop = "a", .slot_hours = 3}});
  EXPECT_THAT(announce().confirmed, SizeIs(1));
  EXPECT_THAT(announce().confirmed, IsEmpty());
  EXPECT_EQ(listener.heard().back()[0], "loopscope_confirmed");
  EXPECT_EQ(history(), (TextRows{{"a", "valve_stiction", "confirmed", "t", "NULL", "t"}}));
}

/// Windows of times before that are judged later, by `loopscope backfill`.
TEST_F(AnnounceFlagsTest, ListAndHistoryAgreeSinceWhenAFaultIsThere) {
  tell({{.loop = "a", .slot_hours = 9}});
  static_cast<void>(announce());
  tell({{.loop = "a", .code = VerdictCode::healthy, .slot_hours = 1},
        {.loop = "a", .slot_hours = 3},
        {.loop = "a", .slot_hours = 5}});
  EXPECT_THAT(announce().flagged, IsEmpty());
  const TextRows third_hour{{"2026-01-01 03:00:00"}};
  for (const std::string view : {"flagged_loop", "flag_history"})
    EXPECT_EQ(database->rows("SELECT since AT TIME ZONE 'UTC' FROM loopscope." + view), third_hour)
        << view;
}

/// The list costs something: it is made where somebody asks since when.
TEST_F(AnnounceFlagsTest, HistoryAsksTheListOnlyForWhatItTells) {
  const auto lines = [&](const std::string& asked) {
    return column("EXPLAIN SELECT " + asked + " FROM loopscope.flag_history").size();
  };
  EXPECT_GT(lines("since"), 20U);
  EXPECT_LT(lines("code, flagged_at, ended_at"), 10U);
}

TEST_F(AnnounceFlagsTest, AnotherVerdictIsTheSameStay) {
  tell({{.loop = "a", .slot_hours = 1}});
  static_cast<void>(announce());
  tell({{.loop = "a", .code = VerdictCode::tight_tuning, .slot_hours = 2}});
  const FlagAnnouncement second = announce();
  EXPECT_THAT(second.flagged, IsEmpty());
  EXPECT_EQ(second.ended, 0U);
  EXPECT_EQ(history(), (TextRows{{"a", "valve_stiction", "watch", "t", "NULL", "t"}}));
  EXPECT_EQ(value("SELECT code FROM loopscope.flagged_loop"), "tight_tuning");
}

TEST_F(AnnounceFlagsTest, SaysWhatEndedAFlag) {
  tell({{.loop = "a"}, {.loop = "b"}, {.loop = "c"}, {.loop = "d"}, {.loop = "e"}, {.loop = "f"}});
  static_cast<void>(announce());
  tell({{.loop = "e", .code = VerdictCode::not_controlling, .slot_hours = 2},
        {.loop = "f", .code = VerdictCode::healthy, .slot_hours = 2}});
  database->execute(
      "INSERT INTO loopscope.annotation (loop_id, kind) SELECT loop_id, 'acknowledged'"
      " FROM loopscope.loop WHERE name = 'a'");
  Catalogue(settings_for(*database)).set_enabled(std::vector<std::string>{"b"}, false);
  database->execute(
      "UPDATE loopscope.verdict SET confidence = 0.1 WHERE loop_id ="
      " (SELECT loop_id FROM loopscope.loop WHERE name = 'c')");
  const auto id = [this](const char* loop) {
    return std::stoll(
        value(std::string("SELECT loop_id FROM loopscope.loop WHERE name = '") + loop + "'"));
  };
  PlantRounds(settings_for(*database))
      .store({slot(1),
              1,
              4,
              2,
              {{40.0,
                id("a"),
                "a leads",
                {},
                {{id("a"), "source", 1, 0, {}}, {id("d"), "victim", 1, 0, {}}}}}});
  EXPECT_EQ(announce().ended, 6U);
  EXPECT_EQ(database->rows("SELECT loop_name, ended_by FROM loopscope.flag_history ORDER BY 1"),
            (TextRows{{"a", "annotation"},
                      {"b", "disabled"},
                      {"c", "threshold"},
                      {"d", "plant"},
                      {"e", "state"},
                      {"f", "verdict"}}));
}

TEST_F(AnnounceFlagsTest, WhoComesBackAtOnceIsNotAnnouncedAgain) {
  tell({{.loop = "a"}});
  static_cast<void>(announce());
  const char* acknowledge =
      "INSERT INTO loopscope.annotation (loop_id, kind) SELECT loop_id, 'acknowledged'"
      " FROM loopscope.loop";
  database->execute(acknowledge);
  static_cast<void>(announce());
  database->execute("UPDATE loopscope.annotation SET withdrawn_at = now()");
  const Listener listener(database->conninfo());
  const FlagAnnouncement back = announce();
  ASSERT_THAT(back.flagged, SizeIs(1));
  EXPECT_FALSE(back.flagged[0].announced);
  EXPECT_THAT(listener.heard(), IsEmpty());
  database->execute(acknowledge);
  static_cast<void>(announce());
  database->execute(
      "UPDATE loopscope.annotation SET withdrawn_at = now() WHERE withdrawn_at IS NULL;"
      "UPDATE loopscope.flag_notice SET ended_at = ended_at - interval '25 h'");
  EXPECT_TRUE(announce().flagged.at(0).announced) << "a day later it is news";
  EXPECT_THAT(listener.heard(), SizeIs(1));
}

TEST_F(AnnounceFlagsTest, WorkersThatCallAtOnceTellOnce) {
  const Listener listener(database->conninfo());
  std::vector<Story> stories;
  for (int k = 0; k < 20; ++k) stories.push_back({.loop = std::to_string(k)});
  tell(stories);
  std::vector<std::size_t> told(4);
  {
    std::vector<std::jthread> workers;
    for (std::size_t& count : told) {
      workers.emplace_back([&count, this] { count = announce().flagged.size(); });
    }
  }
  EXPECT_EQ(told[0] + told[1] + told[2] + told[3], 20U);
  EXPECT_THAT(listener.heard(), SizeIs(20));
}

TEST_F(AnnounceFlagsTest, LongTextsAreCutToWhatAMessageMayHold) {
  tell({{.loop = "a"}});
  const Listener listener(database->conninfo());
  // Long; and of characters that take six bytes in JSON.
  for (const char* text : {"repeat('summary ', 2000)", "repeat(chr(1), 5000)"}) {
    database->execute(std::string("UPDATE loopscope.verdict SET summary = ") + text +
                      ", action = " + text + "; UPDATE loopscope.loop SET name = left(" + text +
                      ", 900); DELETE FROM loopscope.flag_notice");
    EXPECT_THAT(announce().flagged, SizeIs(1));
    const TextRows heard = listener.heard();
    ASSERT_THAT(heard, SizeIs(1)) << text;
    const auto message = nlohmann::json::parse(heard[0][1]);
    EXPECT_TRUE(message["summary"].get<std::string>().ends_with("...")) << text;
    EXPECT_GT(heard[0][1].size(), 4000U) << "as much as there is room for";
  }
}

TEST_F(AnnounceFlagsTest, NothingIsToldOfWhatCannotBeNoted) {
  tell({{.loop = "a"}});
  const Listener listener(database->conninfo());
  database->execute(
      "ALTER TABLE loopscope.flag_notice ADD CONSTRAINT none CHECK (loop_id < 0) NOT VALID");
  EXPECT_THROW(static_cast<void>(announce()), DatabaseError);
  EXPECT_THAT(listener.heard(), IsEmpty());
  EXPECT_THAT(history(), IsEmpty());
}

}  // namespace
}  // namespace loopscope::storage
