#include "storage/session_setup.hpp"

#include <gmock/gmock.h>
#include <memory>
#include <optional>

#include "storage/check_connection.hpp"
#include "storage/error.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/setup/check_historian.hpp"
#include "storage/query_once.hpp"
#include "storage/results/schema/check_results.hpp"
#include "storage/results/session/session.hpp"
#include "tests/storage/running_statement.hpp"
#include "tests/support/pooler.hpp"
#include "tests/support/test_database.hpp"

namespace loopscope::storage {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const Statement kPromises{
    "promises",
    "SELECT current_setting('search_path'), current_setting('statement_timeout'),"
    " current_setting('lock_timeout'), current_setting('TimeZone'),"
    " current_setting('plan_cache_mode'), current_setting('default_transaction_read_only')",
    Rows::one};

/// Both kinds of connections, by libpqxx and by libpq, by way of a PgBouncer.
class SessionSetupTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!tests::test_server()) GTEST_SKIP() << tests::kNoServer;
    if (!tests::has_pooler()) GTEST_SKIP() << tests::kNoPooler;
    database_ = std::make_unique<tests::TestDatabase>();
    user_ = database_->make_login("");
  }

  void start(const std::string& mode, const std::string& more = "") {
    pooler_.emplace(mode, std::vector{user_}, more);
  }
  [[nodiscard]] ConnectionSettings settings(const std::string& more = "") const {
    ConnectionSettings settings;
    settings.conninfo = pooler_->conninfo(database_->conninfo(user_)) + more;
    settings.purpose = "plant";
    return settings;
  }

  void expect_refused(const std::string& words) const {
    for (const bool by_libpqxx : {true, false}) {
      try {
        if (by_libpqxx) {
          const Session session(settings());
        } else {
          const PqConnection connection(settings());
        }
        ADD_FAILURE() << "connected" << (by_libpqxx ? " by libpqxx" : "");
      } catch (const DatabaseError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr(words), HasSubstr("plant database (")));
        EXPECT_THAT(error.hint(), AllOf(HasSubstr("PgBouncer"), HasSubstr("pool_mode = session"),
                                        HasSubstr("the server itself")));
        EXPECT_EQ(error.remedy(), Remedy::give_up);
      }
    }
  }

  std::unique_ptr<tests::TestDatabase> database_;
  std::string user_;
  std::optional<tests::Pooler> pooler_;
};

TEST_F(SessionSetupTest, SessionModeKeepsWhatIsPromised) {
  start("session");
  Session session(settings());
  for (int transaction = 0; transaction < 2; ++transaction) {
    const pqxx::result row = session.transact([](Transaction& t) { return t.run(kPromises); });
    EXPECT_STREQ(row[0][0].c_str(), "pg_catalog, pg_temp");
    EXPECT_STREQ(row[0][1].c_str(), "1min");
    EXPECT_STREQ(row[0][2].c_str(), "5s");
    EXPECT_STREQ(row[0][3].c_str(), "UTC");
    EXPECT_STREQ(row[0][4].c_str(), "force_custom_plan");
  }
  ConnectionSettings reading = settings();
  reading.read_only = true;
  PqConnection connection(reading);
  for (int statement = 0; statement < 2; ++statement) {
    const PqRows row = connection.run(kPromises);
    EXPECT_EQ(row.text(0, 0), "pg_catalog, pg_temp");
    EXPECT_EQ(row.text(0, 1), "1min");
    EXPECT_EQ(row.text(0, 5), "on");
  }
  EXPECT_EQ(connection.own_schemas(), "{public}");
}

TEST_F(SessionSetupTest, TheUsersOwnSettingsArriveToo) {
  start("session");
  const std::string own = " options='-c statement_timeout=7s --search-path=pg_temp'";
  Session session(settings(own));
  const pqxx::result row = session.transact([](Transaction& t) { return t.run(kPromises); });
  EXPECT_STREQ(row[0][0].c_str(), "pg_temp");
  EXPECT_STREQ(row[0][1].c_str(), "7s");
  PqConnection connection(settings(own));
  EXPECT_EQ(connection.run(kPromises).text(0, 1), "7s");
  EXPECT_EQ(connection.run(kPromises).text(0, 0), "pg_temp");
}

TEST_F(SessionSetupTest, WhatOneClientSetsTheNextDoesNotFind) {
  start("session", "default_pool_size = 1\n");
  { const Session session(settings()); }
  EXPECT_EQ(query_once(settings(), "SHOW statement_timeout"), "0");
}

TEST_F(SessionSetupTest, AFullPoolInSessionModeIsNoReasonToRefuse) {
  start("session", "default_pool_size = 1\n");
  Session session(settings());
  EXPECT_STREQ(session.transact([](Transaction& t) { return t.run(kPromises); })[0][1].c_str(),
               "1min");
}

TEST_F(SessionSetupTest, TransactionModeIsRefused) {
  start("transaction");
  expect_refused("another client was given the same session");
  // Nothing is left behind in the sessions of others.
  EXPECT_EQ(query_once(settings(), "SHOW statement_timeout"), "0");
  EXPECT_EQ(query_once(settings(), "SHOW default_transaction_read_only"), "off");
}

TEST_F(SessionSetupTest, TransactionModeThatSwallowsWhatIsSetAtTheStartIsRefused) {
  start("transaction", "ignore_startup_parameters = options\n");
  expect_refused("another client was given the same session");
}

TEST_F(SessionSetupTest, TransactionModeWithSessionsInTurnIsRefused) {
  start("transaction", "server_round_robin = 1\nignore_startup_parameters = options\n");
  const std::string through = pooler_->conninfo(database_->conninfo(user_));
  {
    // Two sessions that stay in the pool.
    const tests::SqlConnection one(through), other(through);
    one.run("BEGIN");
    other.run("BEGIN");
    one.run("COMMIT");
    other.run("COMMIT");
  }
  expect_refused("session");
}

TEST_F(SessionSetupTest, StatementModeIsRefused) {
  start("statement");
  expect_refused("session");
}

TEST_F(SessionSetupTest, StatementThatNobodyWaitsForIsCancelledThroughIt) {
  start("session");
  ConnectionSettings quick = settings(" options='-c statement_timeout=0'");
  quick.statement_timeout_s = 1;
  Session session(quick);
  const Statement sleep{"sleep", "SELECT pg_sleep(61)", Rows::one};
  EXPECT_THROW(session.transact([&](Transaction& t) { t.run(sleep); }), DatabaseError);
  EXPECT_TRUE(ends_soon(*database_, sleep.sql));
}

TEST_F(SessionSetupTest, CheckConfigSaysSoOfBothDatabases) {
  start("transaction");
  for (const std::vector<Finding>& findings :
       {check_results(settings()), check_historian(settings(), SourceLayout{})}) {
    EXPECT_FALSE(findings.back().ok);
    EXPECT_THAT(findings.back().what, HasSubstr("another client was given the same session"));
    EXPECT_THAT(findings.back().hint, HasSubstr("pool_mode = session"));
  }
}

}  // namespace
}  // namespace loopscope::storage
