#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/support/test_database.hpp"

namespace loopscope::tests {

/// What every vendor's tables are filled from and compared with: rows of loops FIC1, FIC2, ...
/// every 10 s from 2026-02-27 00:00:00.125 UTC on (so that a month ends among them), a setpoint in
/// steps, a noisy pv and an op of whole numbers (some vendors keep those apart).
class Truth {
 public:
  /// Makes the table `truth` (loop, k, time, sp, pv, op).
  Truth(const TestDatabase& database, int loops, int rows);

  struct Row {
    std::int64_t time_us;
    double value;
    bool operator==(const Row&) const = default;
  };
  /// The rows of one role of one loop between two rows, both included, by plain SQL.
  [[nodiscard]] std::vector<Row> rows(int loop, const std::string& role, int from, int to) const;
  /// Time of row `k`.
  [[nodiscard]] static std::int64_t time_us(int k);

 private:
  const TestDatabase& database_;
};

}  // namespace loopscope::tests
