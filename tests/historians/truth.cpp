#include "tests/historians/truth.hpp"

#include <cstdlib>

namespace loopscope::tests {

Truth::Truth(const TestDatabase& database, int loops, int rows) : database_(database) {
  database.execute(
      "CREATE TABLE truth AS SELECT i AS loop, k,"
      " timestamptz '2026-02-27 00:00:00.125+00' + k * interval '10 seconds' AS time,"
      " 50.0::float8 + (k / 700) % 3 AS sp,"
      " 50.0::float8 + (k / 700) % 3 + sin(k * 0.07 * i)"
      " + (hashint4extended(k, i) % 1000000) / 700001.0::float8 AS pv,"
      " (40 + (hashint4extended(k, i + 77) % 20))::float8 AS op"
      " FROM generate_series(1, " +
      std::to_string(loops) + ") AS i, generate_series(0, " + std::to_string(rows - 1) +
      ") AS k; CREATE INDEX ON truth (loop, k); ANALYZE truth");
}

std::vector<Truth::Row> Truth::rows(int loop, const std::string& role, int from, int to) const {
  std::vector<Row> found;
  for (const auto& row :
       database_.rows("SELECT (extract(epoch FROM time) * 1000000)::int8, " + role +
                      " FROM truth WHERE loop = " + std::to_string(loop) + " AND k BETWEEN " +
                      std::to_string(from) + " AND " + std::to_string(to) + " ORDER BY k")) {
    found.push_back({std::stoll(row[0]), std::strtod(row[1].c_str(), nullptr)});
  }
  return found;
}

std::int64_t Truth::time_us(int k) {
  constexpr std::int64_t kFirst_us = 1'772'150'400'125'000;  // 2026-02-27 00:00:00.125 UTC
  return kFirst_us + std::int64_t{k} * 10'000'000;
}

}  // namespace loopscope::tests
