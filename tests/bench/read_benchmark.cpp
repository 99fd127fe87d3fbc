// Values per second that the historian's reader takes out of a table with a covering index, beside
// COPY BINARY of the same rows on the same server in the same run: read_benchmark [tags [rounds]].
// Needs the throw-away server of tests/support/postgres.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <libpq-fe.h>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "storage/historian/historian_reader.hpp"
#include "tests/support/test_database.hpp"

namespace loopscope::tests {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kRowsOfTag = 8192;
constexpr int kWindow = 4096;
constexpr std::int64_t kFirst_us = 1'767'225'600'000'000;  // 2026-01-01
constexpr std::int64_t kLast_us = kFirst_us + std::int64_t{kRowsOfTag - 1} * 1'000'000;
// 16 loops of three tags a statement, as COPY measured best.
constexpr int kTagsOfCopy = 48;

/// Rows lie in the order of their times, as a historian writes them.
void fill(const TestDatabase& database, int tags) {
  database.execute(
      "CREATE TABLE history (tag text NOT NULL, time timestamptz NOT NULL, value float8,"
      " quality smallint);"
      "INSERT INTO history SELECT 'FIC' || tag || '.PV', timestamptz '2026-01-01 00:00:00+00'"
      " + k * interval '1 second', hashint4extended(k, tag) / 1e18, 192"
      " FROM generate_series(0, " +
      std::to_string(kRowsOfTag - 1) + ") AS k, generate_series(1, " + std::to_string(tags) +
      ") AS tag ORDER BY k;"
      "CREATE INDEX ON history (tag, time) INCLUDE (value, quality)");
  // Pages become all-visible only once their commits are on disk, which the throw-away server
  // leaves for later: without them an index-only scan looks into the table for every row.
  database.execute("CHECKPOINT");
  database.execute("VACUUM ANALYZE history");
}

std::string tag(int number) {
  return "FIC" + std::to_string(number) + ".PV";
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Reads every window with the program's reader; returns seconds.
double read_ours(storage::HistorianReader& reader, int tags, std::size_t& rows) {
  std::vector<storage::TagRequest> requests;
  for (int number = 1; number <= tags; ++number) {
    requests.push_back({tag(number), kLast_us - std::int64_t{kWindow - 1} * 1'000'000, kLast_us,
                        2 * kWindow, storage::RowBefore::no});
  }
  const auto start = Clock::now();
  const auto series = reader.read(requests);
  const double seconds = seconds_since(start);
  rows = 0;
  for (const auto& one : series) rows += one.value.size();
  return seconds;
}

/// The same rows by COPY BINARY, the bytes thrown away; returns seconds.
double read_by_copy(PGconn* connection, int tags, std::size_t& bytes) {
  bytes = 0;
  const auto start = Clock::now();
  for (int first = 1; first <= tags; first += kTagsOfCopy) {
    std::string names;
    for (int number = first; number < std::min(first + kTagsOfCopy, tags + 1); ++number) {
      names += (names.empty() ? "'" : ", '") + tag(number) + "'";
    }
    const std::string sql =
        "COPY (SELECT t.slot, x.time, x.value, x.quality FROM unnest(ARRAY[" + names +
        "]) WITH ORDINALITY AS t (tag, slot) CROSS JOIN LATERAL (SELECT time, value, quality"
        " FROM history WHERE tag = t.tag AND time >= '2026-01-01 01:08:16+00' AND time <="
        " '2026-01-01 02:16:31+00' ORDER BY time DESC LIMIT 8192) AS x) TO STDOUT (FORMAT binary)";
    PQclear(PQexec(connection, sql.c_str()));
    char* buffer = nullptr;
    for (int length = 0; (length = PQgetCopyData(connection, &buffer, 0)) > 0;) {
      bytes += static_cast<std::size_t>(length);
      PQfreemem(buffer);
    }
    while (PGresult* rest = PQgetResult(connection)) PQclear(rest);
  }
  return seconds_since(start);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void run(int tags, int rounds) {
  const TestDatabase database;
  fill(database, tags);
  storage::ConnectionSettings settings;
  settings.conninfo = database.conninfo();
  storage::HistorianReader reader(settings, storage::SourceLayout{});
  const std::unique_ptr<PGconn, void (*)(PGconn*)> copy(
      PQconnectdb((database.conninfo() + " options='-c jit=off'").c_str()), PQfinish);
  std::vector<double> ours, theirs, ratios;
  std::size_t rows = 0, bytes = 0;
  for (int round = 0; round <= rounds; ++round) {
    const double by_reader = read_ours(reader, tags, rows);
    const double by_copy = read_by_copy(copy.get(), tags, bytes);
    if (round == 0) continue;  // warms the cache
    ours.push_back(by_reader);
    theirs.push_back(by_copy);
    ratios.push_back(by_copy / by_reader);
  }
  if (rows != static_cast<std::size_t>(tags) * kWindow)
    throw std::runtime_error("rows are missing");
  const auto per_second = [rows](double seconds) { return static_cast<double>(rows) / seconds; };
  std::printf(
      "{\"rows\": %zu, \"read_values_per_s\": %.0f, \"copy_values_per_s\": %.0f, "
      "\"read_ratio_copy\": %.2f}\n",
      rows, per_second(median(ours)), per_second(median(theirs)), median(ratios));
}

}  // namespace
}  // namespace loopscope::tests

int main(int argc, char** argv) {
  try {
    loopscope::tests::run(argc > 1 ? std::atoi(argv[1]) : 300, argc > 2 ? std::atoi(argv[2]) : 7);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
