#include <gmock/gmock.h>

#include "storage/check_connection.hpp"
#include "storage/historian/historian_writer.hpp"
#include "storage/historian/list_tags.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/setup/check_historian.hpp"
#include "storage/results/schema/check_results.hpp"
#include "storage/results/schema/migrate.hpp"
#include "tests/storage/historian/historian_fixture.hpp"
#include "tests/storage/results/results_fixture.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::storage {
namespace {

using testing::ElementsAre;

/// Somebody who may make objects in `public` puts functions, operators and tables there that stand
/// in for PostgreSQL's (tests/support/traps.sql), and the logins of the program look there first.
class SearchPathTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!tests::test_server()) GTEST_SKIP() << tests::kNoServer;
    database = std::make_unique<tests::TestDatabase>();
    database->make_roles();
    owner = login("loopscope_owner");
    worker = login("loopscope_worker");
    reader = login("loopscope_historian");
    database->execute("CREATE SCHEMA site; GRANT USAGE ON SCHEMA site TO loopscope_historian");
  }

  /// Each of them ends the statement that falls for it.
  void lay_traps() const {
    database->execute(tests::content_of(tests::source_dir() / "tests" / "support" / "traps.sql"));
  }

  /// Looks into public first, as `ALTER ROLE ... SET search_path` may say.
  std::string login(const std::string& group) const {
    const std::string name = database->make_login(group);
    database->execute("ALTER ROLE " + name + " SET search_path = public, site, pg_catalog");
    return name;
  }

  [[nodiscard]] ConnectionSettings historian(const std::string& user) const {
    ConnectionSettings settings = settings_for(*database, user.empty() ? "postgres" : user);
    settings.purpose = "historian";
    return settings;
  }

  std::unique_ptr<tests::TestDatabase> database;
  std::string owner, worker, reader;
};

TEST_F(SearchPathTest, TrapsAreTraps) {
  lay_traps();
  EXPECT_THROW(database->execute("SET search_path = public, pg_catalog; SELECT now()"),
               std::runtime_error);
  EXPECT_THROW(database->execute("SET search_path = public; SELECT 'a'::varchar = 'a'::text"),
               std::runtime_error)
      << "pg_catalog comes first here, but has no such operator";
}

TEST_F(SearchPathTest, MigratingWorkingAndMaintainingStepIntoNone) {
  lay_traps();
  const auto as_owner = settings_for(*database, owner), as_worker = settings_for(*database, worker);
  EXPECT_FALSE(migrate(as_owner).empty());
  EXPECT_TRUE(migrate(as_owner).empty());
  Catalogue(as_owner).save(std::vector{loop_named("a"), loop_named("b")});
  ResultsDatabase results(as_worker);
  const std::vector<ClaimedLoop> claimed = results.claim_due("w", 60, 10);
  ASSERT_EQ(claimed.size(), 2U);
  EXPECT_TRUE(results.extend(claimed, 60).empty()) << "lost to nobody";
  const std::vector<FailedLoop> failed{{claimed[1].loop.loop_id, claimed[1].fence, "x", 1}};
  EXPECT_EQ(results.finish(std::vector{completed(claimed[0], slot(1), "d1")}, failed).inserted, 1U);
  results.set_parameter("min_confidence", 0.5);
  EXPECT_EQ(Catalogue(as_worker).list().size(), 2U);
  for (const Finding& found : check_results(as_worker)) EXPECT_TRUE(found.ok) << found.what;
  static_cast<void>(maintain(as_owner, {.retention_months = 12}));
}

TEST_F(SearchPathTest, ReadingAHistorianStepsIntoNone) {
  lay_traps();
  SourceLayout layout;
  layout.relation = "site.history";
  ASSERT_TRUE(create_historian_table(historian(""), layout));
  import_rows(historian(""), layout, std::vector{rows_of("a", {1, 2, 3})}, false);
  database->execute("GRANT SELECT ON site.history TO loopscope_historian");
  // With and without the schema: `site` is in the login's own path.
  for (const char* table : {"site.history", "history"}) {
    layout.relation = table;
    HistorianReader rows(historian(reader), layout);
    EXPECT_THAT(read_one(rows, request("a", 1, 9)).value, ElementsAre(2, 3));
    EXPECT_THAT(rows.newest(std::vector<std::string>{"a"}, second(9)), ElementsAre(second(2)));
    EXPECT_THAT(list_tags(historian(reader), layout), ElementsAre("a"));
    for (const Finding& found : check_historian(historian(reader), layout))
      EXPECT_TRUE(found.ok) << found.what;
  }
}

TEST_F(SearchPathTest, VarcharTagsAreComparedByPostgresqlsOwnOperator) {
  lay_traps();
  database->execute(
      "SET search_path = pg_catalog; CREATE TABLE site.short (tag varchar(20), time"
      " pg_catalog.timestamptz, value real, quality int);"
      "INSERT INTO site.short VALUES ('a', '2026-01-01 00:00:01+00', 1.5, 192);"
      "GRANT SELECT ON site.short TO loopscope_historian");
  SourceLayout layout;
  layout.relation = "short";
  HistorianReader rows(historian(reader), layout);
  EXPECT_THAT(read_one(rows, request("a", 0, 9)).value, ElementsAre(1.5));
}

TEST_F(SearchPathTest, AnUnqualifiedTableIsTheFirstInTheLoginsOwnPath) {
  database->execute(
      "SET search_path = pg_catalog; CREATE TABLE site.both (tag text, time pg_catalog.timestamptz,"
      " value real, quality int); CREATE TABLE public.both (x int);"
      "GRANT SELECT ON site.both TO loopscope_historian");
  SourceLayout layout;
  layout.relation = "both";
  EXPECT_THROW(HistorianReader(historian(reader), layout), DatabaseError) << "that of public";
  database->execute("ALTER ROLE " + reader + " SET search_path = site, public");
  EXPECT_NO_THROW(HistorianReader(historian(reader), layout));
}

TEST_F(SearchPathTest, TheSettingsMayChooseThePath) {
  ConnectionSettings chosen = historian(reader);
  chosen.conninfo += " options='-c search_path=site'";
  PqConnection connection(chosen);
  EXPECT_EQ(connection.run({"show", "SHOW search_path"}).text(0, 0), "site");
  PqConnection usual(historian(reader));
  EXPECT_EQ(usual.run({"show", "SHOW search_path"}).text(0, 0), "pg_catalog, pg_temp");
}

}  // namespace
}  // namespace loopscope::storage
