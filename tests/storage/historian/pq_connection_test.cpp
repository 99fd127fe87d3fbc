#include "storage/historian/pq_connection.hpp"

#include <gmock/gmock.h>
#include <new>
#include <string>
#include <vector>

#include "storage/error.hpp"
#include "tests/storage/historian/historian_fixture.hpp"
#include "tests/storage/running_statement.hpp"

namespace loopscope::storage {
namespace {

using testing::HasSubstr;

class PqConnectionTest : public HistorianTest {};

TEST_F(PqConnectionTest, ConnectingToNothingSaysWhereAndHow) {
  ConnectionSettings nowhere = settings();
  nowhere.conninfo = "host=/no/such/folder";
  try {
    PqConnection connection(nowhere);
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_EQ(error.remedy(), Remedy::reconnect);
    EXPECT_THAT(error.what(), HasSubstr("historian database (host=/no/such/folder)"));
  }
}

TEST_F(PqConnectionTest, ErrorLeavesTheConnectionUsable) {
  PqConnection connection(settings());
  EXPECT_THROW(connection.run({"wrong", "SELECT 1/0"}), DatabaseError);
  EXPECT_EQ(connection.run({"right", "SELECT 42"}).text(0, 0), "42");
}

TEST_F(PqConnectionTest, RowsComeOneByOne) {
  PqConnection connection(settings());
  const std::string sql = "SELECT 'row ' || i FROM generate_series(1, 1000) AS i";
  std::vector<std::string> found;
  connection.run_by_row({"rows", sql}, {}, [&](const PqRows& row) {
    ASSERT_EQ(row.size(), 1);
    found.push_back(row.text(0, 0));
  });
  ASSERT_EQ(found.size(), 1000U);
  EXPECT_EQ(found.front(), "row 1");
  EXPECT_EQ(found.back(), "row 1000");
  // Neither the check before it nor the statement after it is taken for its rows.
  EXPECT_EQ(connection.run({"right", sql}).size(), 1000);
}

TEST_F(PqConnectionTest, ErrorAmongRowsLeavesTheConnectionUsable) {
  PqConnection connection(settings());
  int rows = 0;
  const Statement wrong{"wrong", "SELECT 1 / (900 - i) FROM generate_series(1, 1000) AS i"};
  EXPECT_THROW(connection.run_by_row(wrong, {}, [&](const PqRows&) { ++rows; }), DatabaseError);
  EXPECT_LT(rows, 1000);
  EXPECT_EQ(connection.run({"right", "SELECT 42"}).text(0, 0), "42");
}

TEST_F(PqConnectionTest, WhatIsThrownAtARowLeavesTheConnectionUsable) {
  PqConnection connection(settings());
  const Statement rows{"rows", "SELECT i FROM generate_series(1, 1000) AS i"};
  const auto refuse = [](const PqRows&) { throw std::bad_alloc(); };
  EXPECT_THROW(connection.run_by_row(rows, {}, refuse), std::bad_alloc);
  EXPECT_EQ(connection.run({"right", "SELECT 42"}).text(0, 0), "42");
}

TEST_F(PqConnectionTest, RowsThatAStatementDoesNotPromiseAreRefused) {
  PqConnection connection(settings());
  const Statement two{"two", "SELECT i FROM generate_series(1, 2) AS i", Rows::one};
  EXPECT_THROW(connection.run_by_row(two, {}, [](const PqRows&) {}), DatabaseError);
  EXPECT_EQ(connection.run({"right", "SELECT 42"}).text(0, 0), "42");
}

TEST_F(PqConnectionTest, QuotesNamesAndRefusesBytesThatAreNone) {
  const PqConnection connection(settings());
  EXPECT_EQ(connection.quote("we\"ird"), "\"we\"\"ird\"");
  EXPECT_THROW(static_cast<void>(connection.quote("\xff")), DatabaseError);
}

TEST_F(PqConnectionTest, LargeParametersAreSentWhole) {
  PqConnection connection(settings());
  std::string large;
  large.assign(20'000'000, 'x');
  EXPECT_EQ(connection.run({"length", "SELECT length($1)"}, {large}).text(0, 0), "20000000");
}

TEST_F(PqConnectionTest, StatementTimeoutOfTheServerComesFirst) {
  ConnectionSettings quick = settings();
  quick.statement_timeout_s = 1;
  PqConnection connection(quick);
  try {
    connection.run({"sleep", "SELECT pg_sleep(60)"});
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_EQ(error.sqlstate(), "57014");
    EXPECT_EQ(error.remedy(), Remedy::retry);
  }
}

TEST_F(PqConnectionTest, ServerThatStandsStillIsGivenUp) {
  ConnectionSettings quick = settings();
  quick.statement_timeout_s = 1;
  quick.conninfo += " options='-c statement_timeout=0'";
  PqConnection connection(quick);
  try {
    connection.run({"sleep", "SELECT pg_sleep(60)"});
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_EQ(error.remedy(), Remedy::reconnect);
    EXPECT_THAT(error.what(), HasSubstr("did not answer in time"));
  }
  EXPECT_TRUE(ends_soon(*database, "SELECT pg_sleep(60)")) << "cancelled, not left to itself";
}

TEST_F(PqConnectionTest, SettingsThatAreLostEndItBeforeTheNextStatement) {
  for (const char* loss :
       {"SET statement_timeout = 0", "SET search_path = public", "RESET ALL", "DEALLOCATE ALL"}) {
    PqConnection connection(settings());
    connection.run({"loss", loss});
    for (const bool copies : {false, true}) {
      try {
        if (copies) {
          connection.copy_in({"copy", "COPY public.history FROM STDIN"},
                             [](std::string&) { return false; });
        } else {
          connection.run({"delete", "DELETE FROM public.history"});
        }
        ADD_FAILURE() << loss;
      } catch (const DatabaseError& error) {
        EXPECT_EQ(error.remedy(), Remedy::reconnect);
        EXPECT_THAT(error.what(), HasSubstr("no longer"));
        EXPECT_THAT(error.hint(), HasSubstr("pooler"));
      }
    }
  }
}

}  // namespace
}  // namespace loopscope::storage
