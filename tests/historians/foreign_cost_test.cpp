#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <gtest/gtest.h>
#include <iostream>
#include <vector>

#include "storage/historian/historian_reader.hpp"
#include "tests/historians/foreign_fixture.hpp"

namespace loopscope::tests {
namespace {

using storage::RowBefore;
using storage::TagRequest;

class ForeignCost : public Foreign {
 protected:
  void make_tables(const std::string& rows) const;
};

std::string rows_wanted(const char* usual) {
  const char* wanted = std::getenv("LOOPSCOPE_ROWS");
  return wanted == nullptr ? usual : wanted;
}

/// Rows that the server read of its indexes since it started.
std::int64_t rows_read(const MariaDb& mariadb) {
  return std::stoll(mariadb.execute(
      "SELECT sum(variable_value) FROM information_schema.global_status WHERE variable_name IN"
      " ('HANDLER_READ_KEY', 'HANDLER_READ_NEXT', 'HANDLER_READ_PREV')"));
}

/// LOOPSCOPE_ROWS=20000000 is 230 days of one tag, one row a second.
TEST_F(ForeignCost, CostDoesNotGrowWithTheHistory) {
  const std::string rows = rows_wanted("100000");
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

/// The same three tags as native table, and in MariaDB with each key and number of digits.
void ForeignCost::make_tables(const std::string& rows) const {
  const std::string columns =
      " (tag varchar(80) CHARACTER SET utf8mb4 COLLATE utf8mb4_bin NOT NULL,"
      " time datetime(6) NOT NULL, value double, quality int, ";
  mariadb->execute(
      "CREATE TABLE plain" + columns + "KEY (tag, time)); CREATE TABLE covering" + columns +
      "KEY (tag, time, value, quality)); CREATE TABLE clustered" + columns +
      "PRIMARY KEY (tag, time)); CREATE TABLE rounded LIKE covering;"
      "INSERT INTO plain SELECT t.tag, timestamp('2026-03-30') - INTERVAL s.seq SECOND,"
      " 50 + 10 * sin(s.seq * 0.01) + rand(s.seq), 192 FROM seq_1_to_" +
      rows +
      " AS s CROSS JOIN (SELECT 'SP' AS tag UNION SELECT 'PV' UNION SELECT 'OP') AS t"
      " ORDER BY s.seq DESC;"
      "INSERT INTO covering SELECT * FROM plain; INSERT INTO clustered SELECT * FROM plain;"
      "INSERT INTO rounded SELECT tag, time, round(value, 2), quality FROM plain;");
  for (const char* table : {"plain", "covering", "clustered", "rounded"})
    make_foreign(table, table, ", fetch_size '5000'");
  make_foreign("slow", "plain", ", fetch_size '100'");
  database->execute(
      "CREATE TABLE native AS SELECT * FROM plain; CREATE TABLE few AS SELECT * FROM rounded;"
      "CREATE INDEX ON native (tag, time) INCLUDE (value, quality);"
      "CREATE INDEX ON few (tag, time) INCLUDE (value, quality)");
  database->execute("VACUUM ANALYZE native, few");
}

struct Case {
  const char* words;
  const char* table;
  double best_ms = 1e300;
};

std::vector<TagRequest> window_of_a_loop(RowBefore before) {
  std::vector<TagRequest> requests;
  for (const char* tag : {"SP", "PV", "OP"})
    requests.push_back({tag, kEnd_us - 4096 * kSecond_us, kEnd_us, 4096, before, false});
  return requests;
}

/// The shortest of some rounds, by turns: what else the machine does makes none shorter.
void measure(std::vector<Case>& cases, const storage::ConnectionSettings& connection,
             const storage::SourceLayout& layout, RowBefore before) {
  const char* wanted = std::getenv("LOOPSCOPE_ROUNDS");
  const int rounds = wanted == nullptr ? 1 : std::stoi(wanted);
  std::vector<storage::HistorianReader> readers;
  for (Case& of : cases) {
    storage::SourceLayout own = layout;
    own.relation = std::string("public.") + of.table;
    readers.emplace_back(connection, own);
    of.best_ms = 1e300;
  }
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < cases.size(); ++k) {
      const auto start = std::chrono::steady_clock::now();
      const auto window = readers[k].read(window_of_a_loop(before));
      const std::chrono::duration<double, std::milli> took =
          std::chrono::steady_clock::now() - start;
      cases[k].best_ms = std::min(cases[k].best_ms, took.count());
      EXPECT_EQ(window[2].time_us.size(), before == RowBefore::yes ? 4097U : 4096U);
    }
  }
}

/// LOOPSCOPE_ROUNDS=100 measures, with LOOPSCOPE_ROWS=300000; else it only has to work.
TEST_F(ForeignCost, AWindowBesideTheNativeOne) {
  make_tables(rows_wanted("4200"));
  std::vector<Case> cases{{"native, covering index", "native"},
                          {"key (tag, time), fetch_size 100", "slow"},
                          {"key (tag, time), fetch_size 5000", "plain"},
                          {"primary key (tag, time), fetch_size 5000", "clustered"},
                          {"covering key, fetch_size 5000", "covering"},
                          {"native, values of two decimals", "few"},
                          {"covering key, values of two decimals", "rounded"}};
  const auto layout = layout_of("", storage::TimeKind::timestamp_utc);
  for (const RowBefore before : {RowBefore::no, RowBefore::yes}) {
    measure(cases, connection(), layout, before);
    std::cout << (before == RowBefore::yes ? "with" : "without") << " the row before\n";
    for (const Case& of : cases)
      std::cout << "  " << of.best_ms << " ms, " << of.best_ms / cases[0].best_ms
                << " times: " << of.words << "\n";
  }
}

}  // namespace
}  // namespace loopscope::tests
