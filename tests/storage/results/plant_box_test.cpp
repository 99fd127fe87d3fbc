#include <cmath>
#include <gmock/gmock.h>

#include "storage/results/plant/plant_rounds.hpp"
#include "storage/results/reports/report_database.hpp"
#include "storage/results/schema/migrate.hpp"
#include "tests/storage/results/upgrade_fixture.hpp"
#include "tests/storage/results/views_fixture.hpp"

/// What a reader is shown of a shared oscillation.
namespace loopscope::storage {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

class PlantBoxTest : public ViewsTest {
 protected:
  [[nodiscard]] std::int64_t id(const std::string& name) const {
    return std::stoll(value("SELECT loop_id FROM loopscope.loop WHERE name = '" + name + "'"));
  }
  /// a swings b, c and d, the less the later in the alphabet.
  [[nodiscard]] PlantEvent event() const {
    PlantEvent event{40.0, id("a"), "a leads", 1e-6, {}};
    event.members = {{id("a"), "source", 0.9, 0.0, 0.8, {"It leads.", "Against it: \"tiny\", \\."}},
                     {id("b"), "victim", 0.6, 3.0, 0.1, {}},
                     {id("c"), "member", 0.15, 5.0, 0.05, {"Lags."}}};
    event.outside = 0.05;
    event.leads = {{id("a"), id("b"), 0.25, 0.125}, {id("b"), id("a"), 0.1}};
    event.traces = {{id("a"), slot(0), 0.5, {1.0, NAN, -2.5}, {2.0, 40.0}, {1e-9, 3.0}},
                    {id("c"), slot(0), 1.0, {}, {}, {}}};
    return event;
  }
  void store(const PlantEvent& event) const {
    PlantRounds(settings_for(*database)).store({slot(1), 1, 30, 5, {event}});
  }
  [[nodiscard]] ReportDatabase report() const { return ReportDatabase(settings_for(*database)); }
};

TEST_F(PlantBoxTest, IsReadAsItWasStored) {
  tell({{.loop = "a"}, {.loop = "b"}, {.loop = "c"}});
  store(event());
  const std::vector<PlantOscillationRow> events = report().plant_oscillations();
  ASSERT_THAT(events, SizeIs(1));
  const PlantOscillationRow& read = events.front();
  EXPECT_EQ(read.outside, 0.05);
  ASSERT_THAT(read.members, SizeIs(3));
  EXPECT_THAT(read.members[0].reasons, ElementsAre("It leads.", "Against it: \"tiny\", \\."));
  EXPECT_THAT(read.members[1].reasons, IsEmpty());
  ASSERT_THAT(read.leads, SizeIs(2));
  EXPECT_EQ(read.leads[0].from_loop_id, id("a"));
  EXPECT_EQ(read.leads[0].to_loop_id, id("b"));
  EXPECT_EQ(read.leads[0].gain, 0.25);
  EXPECT_EQ(read.leads[0].direct, 0.125);
  EXPECT_EQ(read.leads[1].direct, 0.0);
  ASSERT_THAT(read.traces, SizeIs(2));
  EXPECT_EQ(read.traces[0].start_us, slot(0));
  EXPECT_THAT(read.traces[0].error, ElementsAre(1.0, testing::NanSensitiveDoubleEq(NAN), -2.5));
  EXPECT_THAT(read.traces[0].periods_s, ElementsAre(2.0, 40.0));
  EXPECT_THAT(read.traces[0].power, ElementsAre(1e-9, 3.0));
  EXPECT_THAT(read.traces[1].error, IsEmpty());
}

TEST_F(PlantBoxTest, ARoundOfAProgramOfBeforeShowsWhatThereIs) {
  tell({{.loop = "a"}, {.loop = "b"}, {.loop = "c"}});
  store(event());
  database->execute(
      "UPDATE loopscope.plant_oscillation SET outside = NULL, reasons = NULL, leads = NULL,"
      " traces = NULL");
  const std::vector<PlantOscillationRow> events = report().plant_oscillations();
  ASSERT_THAT(events, SizeIs(1));
  EXPECT_EQ(events[0].outside, std::nullopt);
  EXPECT_THAT(events[0].members[0].reasons, IsEmpty());
  EXPECT_THAT(events[0].leads, IsEmpty());
  EXPECT_THAT(events[0].traces, IsEmpty());
}

TEST_F(PlantBoxTest, AHealthyLoopThatIsShakenIsNotShownAsHealthy) {
  tell({{.loop = "a"}, {.loop = "b", .code = kHealthy}, {.loop = "c", .code = kHealthy}});
  store(event());
  const std::string shown =
      "SELECT loop_name, own_code, code, follows_oscillation, follows"
      " FROM loopscope.latest_verdict ORDER BY loop_name";
  const std::string of_a =
      " % of its error follows the plant-wide oscillation 1 of a (period 40 s)";
  EXPECT_EQ(database->rows(shown),
            (TextRows{{"a", "valve_stiction", "valve_stiction", "NULL", "NULL"},
                      {"b", "healthy", "external_disturbance", "1", "60" + of_a},
                      {"c", "healthy", "healthy", "1", "15" + of_a}}));
  EXPECT_EQ(value("SELECT string_agg(code, ' ' ORDER BY loop_id) FROM loopscope.verdict"),
            "valve_stiction healthy healthy")
      << "what was stored stays";
  EXPECT_EQ(flagged(), std::vector<std::string>{"a"}) << "the list goes by the verdict";
  ReportDatabase results = report();
  EXPECT_EQ(results.followed_by(id("a")), std::nullopt);
  const auto followed = results.followed_by(id("b"));
  ASSERT_TRUE(followed);
  EXPECT_EQ(followed->source_name, "a");
  EXPECT_EQ(followed->shown_code, "external_disturbance");
  EXPECT_EQ(followed->strength, 0.6);
  for (const LoopRow row : results.loops())
    EXPECT_EQ(row.follows.has_value(), row.name != "a") << row.name;
}

TEST_F(PlantBoxTest, NothingIsSaidOfLaterVerdicts) {
  tell({{.loop = "a"}, {.loop = "b", .code = kHealthy}, {.loop = "c"}});
  store(event());
  tell({{.loop = "b", .code = kHealthy, .slot_hours = 24 * 60}});
  EXPECT_EQ(value("SELECT code FROM loopscope.latest_verdict WHERE loop_name = 'b'"), "healthy");
  EXPECT_EQ(report().followed_by(id("b")), std::nullopt);
}

TEST_F(PlantBoxTest, ListsThatAreNoneAreRefused) {
  tell({{.loop = "a"}, {.loop = "b"}, {.loop = "c"}});
  store(event());
  for (const char* spoilt : {"leads = '{}'", "traces = '1'", "reasons = '{x}'", "outside = 1.5"})
    EXPECT_THROW(database->execute(std::string("UPDATE loopscope.plant_oscillation SET ") + spoilt),
                 std::runtime_error)
        << spoilt;
}

using PlantBoxUpgradeTest = UpgradeTest;

/// A filled schema 26 with an event, brought to the end of the chain: the row stays as it is,
/// claims nothing new, and is shown.
TEST_F(PlantBoxUpgradeTest, EventsOfSchema26StayAndAreFollowed) {
  tests::TestDatabase other;
  const std::string login = fill_former_schema(other, 26);
  other.execute(
      "INSERT INTO loopscope.plant_oscillation (slot_end, algorithm_revision, number, period_s,"
      " loop_ids, strengths, lags_s, source_loop_id, statement, roles, scores, p)"
      " SELECT '2026-01-01 01:00:00+00', 1, 1, 300, array_agg(loop_id ORDER BY name), '{0.9,0.5}',"
      " '{0,3}', min(loop_id), 'a leads', '{source,victim}', '{0.7,0.2}', 1e-6"
      " FROM loopscope.loop WHERE enabled;"
      "UPDATE loopscope.plant_round SET events = 1;"
      "UPDATE loopscope.schedule SET result_slot_end = '2026-01-01 01:00:00+00';"
      "UPDATE loopscope.verdict SET code = 'healthy'");
  const std::string row =
      "SELECT row(slot_end, number, period_s, loop_ids, strengths, lags_s, source_loop_id,"
      " statement, roles, scores, p, found_at)::text FROM loopscope.plant_oscillation";
  const TextRows before_it = other.rows(row);
  other.execute("SET ROLE loopscope_owner;" + former_script(26, superseded_migrations().size()));
  migrate(settings_for(other, login));
  EXPECT_EQ(other.rows(row), before_it);
  EXPECT_EQ(other.rows("SELECT num_nonnulls(outside, reasons, leads, traces)"
                       " FROM loopscope.plant_oscillation"),
            (TextRows{{"0"}}));
  EXPECT_EQ(other.rows("SELECT own_code, code, follows FROM loopscope.latest_verdict"
                       " WHERE loop_name = 'b'"),
            (TextRows{{"healthy", "external_disturbance",
                       "50 % of its error follows the plant-wide oscillation 1 of a"
                       " (period 5 min)"}}));
  EXPECT_THAT(ReportDatabase(settings_for(other, login)).plant_oscillations(), SizeIs(1));
}

/// A worker of schema 26 goes on writing its events.
TEST_F(PlantBoxUpgradeTest, TheFormerProgramsEventsAreTaken) {
  migrate(settings_for(*database, owner));
  const tests::SqlConnection session(database->conninfo(worker));
  EXPECT_EQ(session.run("INSERT INTO loopscope.plant_oscillation (slot_end, algorithm_revision,"
                        " number, period_s, loop_ids, strengths, lags_s, source_loop_id, statement,"
                        " roles, scores, p) VALUES ('2026-01-02', 1, 1, 40, '{1,2}', '{0.9,0.5}',"
                        " '{0,3}', NULL, 'x', '{member,member}', '{0.3,0.2}', 0.001)"
                        " ON CONFLICT (slot_end, algorithm_revision, number) DO UPDATE SET"
                        " period_s = EXCLUDED.period_s RETURNING number"),
            (TextRows{{"1"}}));
}

}  // namespace
}  // namespace loopscope::storage
