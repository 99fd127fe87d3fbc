#include <bit>
#include <chrono>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iostream>
#include <random>
#include <sstream>

#include "daemon/service/historians/storage_settings.hpp"
#include "storage/historian/historian_reader.hpp"
#include "storage/historian/list_tags.hpp"
#include "storage/historian/setup/check_historian.hpp"
#include "tests/historians/foreign_fixture.hpp"
#include "tests/historians/truth.hpp"
#include "tests/historians/vendor.hpp"

namespace loopscope::tests {
namespace {

using storage::RowBefore;
using storage::SourceLayout;
using storage::TagRequest;
using testing::HasSubstr;
using testing::Not;

/// Spans that end within three days, some of them without rows, some cut by the number of rows.
std::vector<TagRequest> random_requests(std::mt19937& random) {
  const auto below = [&random](std::int64_t bound) {
    return std::uniform_int_distribution<std::int64_t>(0, bound - 1)(random);
  };
  std::vector<TagRequest> requests;
  for (const std::int64_t reach : {8'000, 300'000, 90 * 86'400, 400 * 86'400}) {
    const std::int64_t to = kEnd_us - below(reach * kSecond_us);
    const std::int64_t from = to - below(3000 * kSecond_us);
    for (const char* tag : {"FIC1", "SP1", "odd 'tag'", "DEAD", "never there"}) {
      requests.push_back({tag, from, to, below(2) == 0 ? 100'000 : 1 + below(500),
                          below(2) == 0 ? RowBefore::yes : RowBefore::no, false});
    }
  }
  return requests;
}

TEST_F(Foreign, WindowsOfANarrowTableAreBitForBitTheNativeOnes) {
  make_history();
  using storage::TimeKind;
  std::mt19937 random(32);
  std::size_t rows = 0;
  for (const auto& [kind, tiebreak] : {std::pair{TimeKind::timestamp_utc, ""},
                                       {TimeKind::timestamp_local, ""},
                                       {TimeKind::timestamp_utc, "quality"}}) {
    SourceLayout layout = layout_of("native", kind);
    layout.tiebreak_column = tiebreak;
    storage::HistorianReader native(connection(), layout);
    layout.relation = "public.elsewhere";
    storage::HistorianReader elsewhere(connection(), layout);
    for (int round = 0; round < 6; ++round) {
      const auto requests = random_requests(random);
      const auto expected = native.read(requests);
      const auto read = elsewhere.read(requests);
      for (std::size_t k = 0; k < requests.size(); ++k) {
        expect_same(read[k], expected[k], requests[k]);
        rows += expected[k].time_us.size();
      }
    }
  }
  EXPECT_GT(rows, 10'000U);
}

TEST_F(Foreign, NewestRowsAndTagsAreTheNativeOnes) {
  make_history();
  const std::vector<std::string> tags{"FIC1", "SP1", "odd 'tag'", "DEAD", "never there"};
  const auto kind = storage::TimeKind::timestamp_utc;
  storage::HistorianReader native(connection(), layout_of("native", kind));
  storage::HistorianReader elsewhere(connection(), layout_of("elsewhere", kind));
  for (const std::int64_t back_s : {0, 4'000, 100'000, 8'000'000, 200'000'000}) {
    const std::int64_t time_us = kEnd_us - back_s * kSecond_us + 1;
    EXPECT_EQ(elsewhere.newest(tags, time_us), native.newest(tags, time_us)) << back_s;
  }
  EXPECT_EQ(storage::list_tags(connection(), layout_of("elsewhere", kind)),
            storage::list_tags(connection(), layout_of("native", kind)));
}

TEST_F(Foreign, TimesGoOverAndTheOrderOfValuesDoesNot) {
  make_history();
  for (const auto kind : {storage::TimeKind::timestamp_utc, storage::TimeKind::timestamp_local}) {
    storage::HistorianReader elsewhere(connection(), layout_of("elsewhere", kind));
    static_cast<void>(mariadb->statements());
    static_cast<void>(elsewhere.read(std::vector<TagRequest>{
        {"FIC1", kEnd_us - 600 * kSecond_us, kEnd_us, 4096, RowBefore::yes, false}}));
    static_cast<void>(elsewhere.newest(std::vector<std::string>{"FIC1", "SP1"}, kEnd_us));
    std::istringstream sent(mariadb->statements());
    int count = 0;
    for (std::string statement; std::getline(sent, statement); ++count) {
      EXPECT_THAT(statement, HasSubstr("`time` >= ")) << "no history is read from its beginning";
      EXPECT_THAT(statement, Not(HasSubstr("ORDER BY `value`")));
    }
    // The window, the newest time before it, the rows of that time; newest rows: FIC1's within the
    // hour (or, by the clock of Berlin, not), SP1's within the next span.
    EXPECT_GE(count, 5);
    EXPECT_LE(count, 9);
  }
}

TEST_F(Foreign, CheckConfigFindsNoFault) {
  database->execute(
      "CREATE TABLE native (tag text, time timestamp, value float8, quality int);"
      "INSERT INTO native SELECT 'FIC1', (now() AT TIME ZONE 'Europe/Berlin') -"
      " k * interval '1 second', k, 192 FROM generate_series(1, 500) AS k");
  mariadb->execute(
      "CREATE TABLE native (tag varchar(80), time datetime(3), value double,"
      " quality int, KEY (tag, time));" +
      as_insert(*database, "native"));
  make_foreign("elsewhere", "native");
  const auto words_of = [this](const std::string& table) {
    std::string words;
    for (const storage::Finding& finding : storage::check_historian(
             connection(), layout_of(table, storage::TimeKind::timestamp_local))) {
      EXPECT_TRUE(finding.ok) << finding.what;
      words += finding.what + "\n";
    }
    return words;
  };
  const std::string words = words_of("elsewhere");
  EXPECT_THAT(words, HasSubstr("the newest row of FIC1 is of "));
  EXPECT_THAT(words, HasSubstr("times of a window are looked up by the other server"));
  EXPECT_THAT(words, HasSubstr("the other server is asked: SELECT `time`"));
  EXPECT_THAT(words, Not(HasSubstr("uses indexes only")));
  EXPECT_THAT(words, HasSubstr("a window come in portions of 100 from server mariadb"));
  database->execute("ALTER SERVER mariadb OPTIONS (ADD fetch_size '5000')");
  EXPECT_THAT(words_of("elsewhere"), HasSubstr("a window come in portions of 5000"));
  database->execute(
      "CREATE VIEW converted AS SELECT tag, time::text::timestamp AS time, value,"
      " quality FROM elsewhere");
  EXPECT_THAT(words_of("converted"), HasSubstr("the other server sends rows that are thrown away"));
}

TEST_F(Foreign, TimesWithAZoneAreRefused) {
  mariadb->execute(
      "CREATE TABLE native (tag varchar(80), time datetime(3), value double, quality int)");
  database->execute(
      "CREATE FOREIGN TABLE zoned (tag text, time timestamptz, value float8, quality int)"
      " SERVER mariadb OPTIONS (dbname 'plant', table_name 'native')");
  const auto findings =
      storage::check_historian(connection(), layout_of("zoned", storage::TimeKind::timestamptz));
  EXPECT_FALSE(findings.back().ok);
  EXPECT_THAT(findings.back().what, HasSubstr("is timestamptz, which MySQL and MariaDB do not"));
  EXPECT_THAT(findings.back().hint, HasSubstr("declare it as timestamp"));
}

}  // namespace
}  // namespace loopscope::tests
