#include <bit>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "daemon/service/historians/storage_settings.hpp"
#include "storage/historian/historian_reader.hpp"
#include "storage/historian/list_tags.hpp"
#include "storage/historian/setup/check_historian.hpp"
#include "tests/historians/truth.hpp"
#include "tests/historians/vendor.hpp"
#include "tests/support/mariadb.hpp"

namespace loopscope::tests {
namespace {

using storage::RowBefore;
using storage::SourceLayout;
using storage::TagRequest;
using testing::HasSubstr;
using testing::Not;

// 2026-03-30 00:00 UTC: the clocks of Berlin were put forward the day before.
constexpr std::int64_t kEnd_us = 1'774'828'800'000'000;
constexpr std::int64_t kSecond_us = 1'000'000;

/// A history of five tags: one a second with rows of one time and values that are bad, one that
/// keeps still for days, one with fractions of a second, one that died in January, one never there.
constexpr const char* kHistory = R"(
    CREATE TABLE native (tag text NOT NULL, time timestamp NOT NULL, value float8, quality int);
    SELECT setseed(0.32);
    INSERT INTO native SELECT 'FIC1', timestamp '2026-03-30' - k * interval '1 second',
      random() * 1e3, CASE WHEN random() < 0.1 THEN n ELSE 192 + n END
      FROM generate_series(0, 8000) AS k, generate_series(0, (random() * 1.2)::int) AS n;
    INSERT INTO native SELECT 'SP1', timestamp '2026-03-29' - k * k * interval '1 hour',
      k / 7.0 + random(), 192 + n FROM generate_series(0, 60) AS k, generate_series(0, (random() * 2)::int) AS n;
    INSERT INTO native SELECT 'odd ''tag''',
      timestamp '2026-03-30' - (k * 1234567.0 * random()) * interval '1 microsecond',
      exp(random() * 600 - 300) - random(), CASE WHEN random() < 0.1 THEN 64 ELSE 192 END
      FROM generate_series(0, 4000) AS k;
    INSERT INTO native SELECT 'DEAD', timestamp '2026-01-05 12:00' - k * interval '0.5 second',
      k, 192 FROM generate_series(0, 500) AS k;
    CREATE INDEX ON native (tag, time))";

/// The rows of a table of PostgreSQL as an INSERT for MariaDB.
std::string as_insert(const TestDatabase& database, const std::string& table) {
  std::string columns;
  for (const auto& row :
       database.rows("SELECT attname FROM pg_attribute WHERE attnum > 0 AND attrelid = '" + table +
                     "'::regclass ORDER BY attnum")) {
    columns += (columns.empty() ? "" : " || ',' || ") + ("quote_nullable(" + row[0] + "::text)");
  }
  const std::string values =
      database.value("SELECT string_agg('(' || " + columns + " || ')', ',') FROM " + table);
  return "INSERT INTO " + table + " VALUES " + values + ";";
}

class Foreign : public testing::Test {
 protected:
  void SetUp() override {
    if (!test_server()) GTEST_SKIP() << kNoServer;
    if (!has_mariadb()) GTEST_SKIP() << kNoMariaDb;
    database.emplace();
    mariadb.emplace();
    database->execute(mariadb->server_sql());
  }

  void make_history() {
    database->execute(kHistory);
    mariadb->execute(
        "CREATE TABLE native (tag varchar(80) CHARACTER SET utf8mb4 COLLATE utf8mb4_bin NOT NULL,"
        " time datetime(6) NOT NULL, value double, quality int, KEY (tag, time));" +
        as_insert(*database, "native"));
    database->execute(
        "CREATE FOREIGN TABLE elsewhere (tag text, time timestamp, value float8, quality int)"
        " SERVER mariadb OPTIONS (dbname 'plant', table_name 'native')");
  }

  [[nodiscard]] storage::ConnectionSettings connection() const {
    storage::ConnectionSettings settings;
    settings.conninfo = database->conninfo();
    settings.purpose = "historian";
    return settings;
  }

  static SourceLayout layout_of(const std::string& table, storage::TimeKind kind) {
    SourceLayout layout;
    layout.relation = "public." + table;
    layout.time_kind = kind;
    if (kind == storage::TimeKind::timestamp_local) layout.time_zone = "Europe/Berlin";
    return layout;
  }

  std::optional<TestDatabase> database;
  std::optional<MariaDb> mariadb;
};

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

TEST_F(Foreign, CheckConfigFindsNoFault) {
  database->execute(
      "CREATE TABLE native (tag text, time timestamp, value float8, quality int);"
      "INSERT INTO native SELECT 'FIC1', (now() AT TIME ZONE 'Europe/Berlin') -"
      " k * interval '1 second', k, 192 FROM generate_series(1, 500) AS k");
  mariadb->execute(
      "CREATE TABLE native (tag varchar(80), time datetime(3), value double,"
      " quality int, KEY (tag, time));" +
      as_insert(*database, "native"));
  database->execute(
      "CREATE FOREIGN TABLE elsewhere (tag text, time timestamp, value float8, quality int)"
      " SERVER mariadb OPTIONS (dbname 'plant', table_name 'native')");
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
