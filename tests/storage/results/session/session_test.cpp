#include "storage/results/session/session.hpp"

#include <gmock/gmock.h>
#include <thread>

#include "tests/storage/results/results_fixture.hpp"
#include "tests/storage/running_statement.hpp"

namespace loopscope::storage {
namespace {

using testing::HasSubstr;

class SessionTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!tests::test_server()) GTEST_SKIP() << tests::kNoServer;
    database = std::make_unique<tests::TestDatabase>();
    database->make_roles();
  }
  std::unique_ptr<tests::TestDatabase> database;
};

const Statement kSelect{"select_one", "SELECT 1", Rows::one};

/// The error that connecting with these settings gives.
DatabaseError connect_error(const ConnectionSettings& settings) {
  try {
    Session session(settings);
  } catch (const DatabaseError& error) {
    return error;
  }
  return {"no error", "", Remedy::retry};
}

TEST_F(SessionTest, ConnectingToNothingSaysWhereAndHow) {
  ConnectionSettings settings;
  settings.conninfo = "host=/no/such/folder dbname=plant";
  settings.purpose = "results";
  const DatabaseError error = connect_error(settings);
  EXPECT_EQ(error.remedy(), Remedy::reconnect);
  EXPECT_THAT(error.what(), HasSubstr("/no/such/folder"));
  EXPECT_THAT(error.hint(), HasSubstr("server runs"));
}

TEST_F(SessionTest, RoleAndDatabaseThatAreMissingAreNamed) {
  DatabaseError error = connect_error(settings_for(*database, "nobody_of_that_name"));
  EXPECT_EQ(error.remedy(), Remedy::give_up);
  EXPECT_THAT(error.what(), HasSubstr("role \"nobody_of_that_name\" does not exist"));
  EXPECT_THAT(error.hint(), HasSubstr("CREATE ROLE"));

  ConnectionSettings settings = settings_for(*database);
  settings.conninfo += " dbname=no_such_database";
  error = connect_error(settings);
  EXPECT_EQ(error.remedy(), Remedy::give_up);
  EXPECT_THAT(error.what(), HasSubstr("database \"no_such_database\" does not exist"));
}

TEST_F(SessionTest, SessionIsSetUpTheSameOnEveryServer) {
  database->execute("ALTER DATABASE " + database->name() + " SET timezone = 'Asia/Kathmandu'");
  Session session(settings_for(*database));
  const Statement show{"show",
                       "SELECT current_setting('TimeZone') || ' ' || current_setting('jit') || ' '"
                       " || current_setting('statement_timeout') || ' ' ||"
                       " current_setting('plan_cache_mode')",
                       Rows::one};
  EXPECT_STREQ(session.transact([&](Transaction& t) { return t.run(show); })[0][0].c_str(),
               "UTC off 1min force_custom_plan");
}

TEST_F(SessionTest, FailedWorkStoresNothingAndTheSessionGoesOn) {
  database->execute("CREATE TABLE kept (x int); GRANT ALL ON kept TO PUBLIC");
  Session session(settings_for(*database));
  const Statement insert{"insert", "INSERT INTO public.kept VALUES (1)", Rows::none};
  const Statement wrong{"wrong", "SELECT * FROM no_such_table"};
  EXPECT_THROW(session.transact([&](Transaction& t) {
    t.run(insert);
    t.run(wrong);
  }),
               DatabaseError);
  EXPECT_EQ(database->value("SELECT count(*) FROM kept"), "0");
  session.transact([&](Transaction& t) { t.run(insert); });
  EXPECT_EQ(database->value("SELECT count(*) FROM kept"), "1");
}

TEST_F(SessionTest, BrokenPromiseAboutRowsIsAnError) {
  Session session(settings_for(*database));
  const Statement two{"two", "SELECT * FROM (VALUES (1), (2)) AS v", Rows::one};
  EXPECT_THROW(session.transact([&](Transaction& t) { t.run(two); }), DatabaseError);
}

TEST_F(SessionTest, APlanThatIsKeptLeavesOtherStatementsToTheirValues) {
  Session session(settings_for(*database));
  session.transact([](Transaction& t) {
    t.run({"plan", "SELECT $1::integer", Rows::one, Kept::plan}, {"1"});
    EXPECT_STREQ(t.run({"mode", "SELECT current_setting('plan_cache_mode')"})[0][0].c_str(),
                 "force_custom_plan");
  });
}

TEST_F(SessionTest, WhatIsKeptOfAStatementIsUsedAgain) {
  Session session(settings_for(*database));
  const Statement text{"text", "SELECT $1::integer", Rows::one, Kept::text};
  const Statement plan{"plan", "SELECT $1::integer + 1", Rows::one, Kept::plan};
  for (const char* value : {"1", "2"}) {
    session.transact([&](Transaction& t) {
      EXPECT_STREQ(t.run(text, {value})[0][0].c_str(), value);
      EXPECT_EQ(t.run(plan, {value})[0][0].as<int>(), std::stoi(value) + 1);
      EXPECT_STREQ(t.run(text, {value})[0][0].c_str(), value);
    });
  }
  session.transact([](Transaction& t) {
    const pqxx::result kept =
        t.run({"kept",
               "SELECT name, generic_plans > 0, custom_plans > 0 FROM pg_prepared_statements"
               " WHERE name IN ('plan', 'text') ORDER BY name"});
    ASSERT_EQ(kept.size(), 2u);
    EXPECT_TRUE(kept[0][1].as<bool>());
    EXPECT_FALSE(kept[0][2].as<bool>());
    EXPECT_FALSE(kept[1][1].as<bool>());
    EXPECT_TRUE(kept[1][2].as<bool>());
  });
}

TEST_F(SessionTest, SerialisationFailureAsksForARetry) {
  database->execute(
      "CREATE TABLE counter (x int); INSERT INTO counter VALUES (0);"
      " GRANT ALL ON counter TO PUBLIC");
  ConnectionSettings settings = settings_for(*database);
  settings.conninfo += R"( options='-c default_transaction_isolation=repeatable\\ read')";
  Session session(settings);
  const Statement read{"read", "SELECT x FROM public.counter", Rows::one};
  const Statement write{"write", "UPDATE public.counter SET x = x + 1", Rows::none};
  try {
    session.transact([&](Transaction& t) {
      t.run(read);
      database->execute("UPDATE counter SET x = 10");
      t.run(write);
    });
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_EQ(error.remedy(), Remedy::retry);
    EXPECT_EQ(error.sqlstate(), "40001");
  }
}

TEST_F(SessionTest, ServerThatIsGoneAtCommitLeavesTheCommitInDoubt) {
  Session session(settings_for(*database));
  try {
    session.transact([&](Transaction& t) {
      t.run(kSelect);
      database->execute(
          "SELECT pg_terminate_backend(pid) FROM pg_stat_activity"
          " WHERE datname = current_database() AND pid <> pg_backend_pid()");
    });
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_EQ(error.remedy(), Remedy::reconnect);
    EXPECT_THAT(error.what(), HasSubstr("commit"));
  }
  EXPECT_THROW(session.transact([&](Transaction& t) { t.run(kSelect); }), DatabaseError);
}

TEST_F(SessionTest, ServerThatStandsStillIsGivenUp) {
  ConnectionSettings settings = settings_for(*database);
  settings.statement_timeout_s = 1;
  // The server's own time limit is off, as if it were too busy to keep it.
  settings.conninfo += " options='-c statement_timeout=0'";
  Session session(settings);
  const Statement sleep{"sleep", "SELECT pg_sleep(60)", Rows::one};
  try {
    session.transact([&](Transaction& t) { t.run(sleep); });
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_EQ(error.remedy(), Remedy::reconnect);
    EXPECT_THAT(error.what(), HasSubstr("did not answer in time"));
  }
  EXPECT_TRUE(ends_soon(*database, "SELECT pg_sleep(60)")) << "cancelled, not left to itself";
}

TEST_F(SessionTest, SettingsThatAreLostEndItBeforeTheNextStatement) {
  database->execute("CREATE TABLE kept (x int)");
  const Statement insert{"insert", "INSERT INTO public.kept VALUES (1)", Rows::none};
  for (const char* loss :
       {"SET statement_timeout = 0", "SET search_path = public", "RESET ALL", "DEALLOCATE ALL"}) {
    Session session(settings_for(*database));
    session.transact([&](Transaction& t) { t.run({"loss", loss}); });
    try {
      session.transact([&](Transaction& t) { t.run(insert); });
      ADD_FAILURE() << loss;
    } catch (const DatabaseError& error) {
      EXPECT_EQ(error.remedy(), Remedy::reconnect);
      EXPECT_THAT(error.what(), HasSubstr("no longer"));
      EXPECT_THAT(error.hint(), HasSubstr("pooler"));
    }
  }
  EXPECT_EQ(database->value("SELECT count(*) FROM kept"), "0");
}

TEST_F(SessionTest, SettingThatTheServerRefusesIsLookedForInOptions) {
  ConnectionSettings settings = settings_for(*database);
  settings.conninfo += " options='-c statement_timeout=soon'";
  const DatabaseError error = connect_error(settings);
  EXPECT_EQ(error.remedy(), Remedy::give_up);
  EXPECT_THAT(error.what(), HasSubstr("statement_timeout"));
  EXPECT_THAT(error.hint(), HasSubstr("options="));
}

}  // namespace
}  // namespace loopscope::storage
