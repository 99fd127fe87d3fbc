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

constexpr std::int64_t kSecond_us = 1'000'000;

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

void expect_same(const core::signal::RawSeries& read, const core::signal::RawSeries& expected,
                 const TagRequest& request) {
  ASSERT_EQ(read.time_us, expected.time_us) << request.tag << request.from_us;
  for (std::size_t k = 0; k < expected.value.size(); ++k) {
    ASSERT_EQ(std::bit_cast<std::uint64_t>(read.value[k]),
              std::bit_cast<std::uint64_t>(expected.value[k]))
        << request.tag << k;
  }
  EXPECT_EQ(read.unknown_quality, expected.unknown_quality) << request.tag;
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

/// Rows that the server read of its indexes since it started.
std::int64_t rows_read(const MariaDb& mariadb) {
  return std::stoll(mariadb.execute(
      "SELECT sum(variable_value) FROM information_schema.global_status WHERE variable_name IN"
      " ('HANDLER_READ_KEY', 'HANDLER_READ_NEXT', 'HANDLER_READ_PREV')"));
}

/// LOOPSCOPE_ROWS=20000000 is 230 days of one tag, one row a second.
TEST_F(Foreign, CostDoesNotGrowWithTheHistory) {
  const char* wanted = std::getenv("LOOPSCOPE_ROWS");
  const std::string rows = wanted == nullptr ? "100000" : wanted;
  mariadb->execute(
      "CREATE TABLE lengths (tag varchar(80) NOT NULL, time datetime(3) NOT NULL,"
      " value double, quality int, KEY (tag, time))");
  for (const auto& [tag, length] : {std::pair{"short", std::string("10000")}, {"long", rows}}) {
    mariadb->execute(
        "INSERT INTO lengths SELECT '" + std::string(tag) +
        "', timestamp('2026-03-30') - INTERVAL seq SECOND, sin(seq), 192 FROM seq_1_to_" + length);
  }
  make_foreign("lengths", "lengths");
  storage::HistorianReader reader(connection(),
                                  layout_of("lengths", storage::TimeKind::timestamp_utc));
  std::vector<std::int64_t> cost;
  for (const std::string tag : {"short", "long"}) {
    const std::int64_t before = rows_read(*mariadb);
    const auto start = std::chrono::steady_clock::now();
    const auto window = reader.read(std::vector<TagRequest>{
        {tag, kEnd_us - 4096 * kSecond_us, kEnd_us, 4096, RowBefore::yes, false}});
    const auto newest = reader.newest(std::vector{tag}, kEnd_us);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(newest[0], kEnd_us - kSecond_us);
    EXPECT_EQ(window[0].time_us.size(), 4097U);
    cost.push_back(rows_read(*mariadb) - before);
    std::cout << tag << ": rows read " << cost.back() << ", ms " << took.count() << "\n";
  }
  EXPECT_EQ(cost[0], cost[1]);
  EXPECT_LT(cost[1], 4096 + 2 * 3600 + 4096) << "the window, an hour before it, the last hour";
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
  database->execute(
      "CREATE VIEW converted AS SELECT tag, time::text::timestamp AS time, value,"
      " quality FROM elsewhere");
  EXPECT_THAT(words_of("converted"), HasSubstr("the other server sends rows that are thrown away"));
}

TEST_F(Foreign, IgnitionsTablesGiveTheWindowsOfTheNativeOnes) {
  const Truth truth(*database, 2, 18'000);
  const Vendor& ignition = vendor("ignition");
  database->execute(ignition.tables);
  mariadb->execute(
      "CREATE TABLE sqlth_te (id int PRIMARY KEY, tagpath varchar(255), scid int, datatype int,"
      " querymode int, created bigint, retired bigint);"
      "CREATE TABLE sqlth_partitions (pname varchar(255), drvid int, start_time bigint,"
      " end_time bigint, blocksize int, flags int);"
      "CREATE TABLE sqlt_data_1_2026_02 (tagid int, intvalue bigint, floatvalue double,"
      " stringvalue varchar(255), datevalue datetime, dataintegrity int, t_stamp bigint,"
      " PRIMARY KEY (tagid, t_stamp), KEY (t_stamp));"
      "CREATE TABLE sqlt_data_2_2026_03 LIKE sqlt_data_1_2026_02;");
  database->execute("CREATE SCHEMA elsewhere");
  for (const char* table :
       {"sqlth_te", "sqlth_partitions", "sqlt_data_1_2026_02", "sqlt_data_2_2026_03"}) {
    mariadb->execute(as_insert(*database, table));
  }
  database->execute("IMPORT FOREIGN SCHEMA plant FROM SERVER mariadb INTO elsewhere");
  auto settings = settings_of(ignition, database->conninfo());
  storage::HistorianReader native(connection(), daemon::historian_layout(settings));
  settings.table = "elsewhere.sqlth_1_data";
  settings.partition_table = "elsewhere.sqlth_partitions";
  settings.tag_table = "elsewhere.sqlth_te";
  storage::HistorianReader elsewhere(connection(), daemon::historian_layout(settings));
  std::vector<TagRequest> requests;
  std::vector<std::string> tags;
  for (const int last : {17'999, 17'500}) {  // over the end of February, too
    for (const char* role : {"sp", "pv", "op"}) {
      tags.push_back(tag_of(ignition, 2, role));
      requests.push_back({tags.back(), Truth::time_us(last - 4095), Truth::time_us(last) + 1, 8192,
                          RowBefore::yes, false});
    }
  }
  const auto expected = native.read(requests);
  const auto read = elsewhere.read(requests);
  for (std::size_t k = 0; k < requests.size(); ++k) {
    EXPECT_GE(expected[k].time_us.size(), 4096U);
    expect_same(read[k], expected[k], requests[k]);
  }
  EXPECT_EQ(elsewhere.newest(tags, Truth::time_us(17'000)),
            native.newest(tags, Truth::time_us(17'000)));
}

}  // namespace
}  // namespace loopscope::tests
