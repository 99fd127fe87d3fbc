// What claims take while an old snapshot is held, beside what they take without one:
// claim_benchmark [loops [periods]]. Needs the throw-away server of tests/support/postgres.
//
// One worker claims batches of 32 and gives them back, as in `run`; all loops of a period are due
// in the same instant, as loops of one period are. Whatever finds nothing counts as a claim: it
// looks back. Ends with 1 where the mean or the 99th percentile is more than twice the undisturbed
// one.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <numeric>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "storage/results/results_database.hpp"
#include "storage/results/schema/migrate.hpp"
#include "tests/support/sql_connection.hpp"
#include "tests/support/test_database.hpp"

namespace loopscope::tests {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kBatch = 32;
constexpr double kMostTimes = 2.0;

/// Milliseconds of each call, in the order of the calls.
struct Times {
  std::vector<double> claim, finish, look_back, health, recall, claim_next;
};

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

template <typename Work>
auto timed(std::vector<double>& times, Work work) {
  const auto start = Clock::now();
  auto result = work();
  times.push_back(milliseconds_since(start));
  return result;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double percentile_99(std::vector<double> values) {
  std::ranges::sort(values);
  return values[(values.size() - 1) * 99 / 100];
}

class Plant {
 public:
  explicit Plant(int loops)
      : loops_(loops), server_(database_.conninfo()), pause_s_(1.0 + 0.0005 * loops) {
    storage::ConnectionSettings settings;
    settings.conninfo = database_.conninfo(database_.owner());
    settings.purpose = "results";
    storage::migrate(settings);
    database_.execute(
        "INSERT INTO loopscope.loop (name, source, pv_tag, period_s)"
        " SELECT 'L' || n, 'plant', 'T' || n, 3600 FROM generate_series(1, " +
        std::to_string(loops) + ") AS n");
    database_.execute("VACUUM ANALYZE loopscope.schedule");
    results_.emplace(settings);
  }

  void hold_snapshot() {
    server_.run("BEGIN ISOLATION LEVEL REPEATABLE READ");
    server_.run("SELECT count(*) FROM loopscope.schedule");
  }

  /// Every loop is visited once; returns what that took.
  Times visit_all() {
    Times times;
    const auto start = Clock::now();
    const std::int64_t due_us =
        results_->clock().now_us + static_cast<std::int64_t>(1e6 * pause_s_);
    for (std::vector<storage::ClaimedLoop> claims; !(claims = claim(times)).empty();)
      finish(claims, due_us, times);
    look(due_us, times);
    const double took_s = milliseconds_since(start) / 1e3;
    pause_s_ = 1.0 + 1.3 * took_s;
    std::this_thread::sleep_for(
        std::chrono::microseconds(due_us - results_->clock().now_us + 1000));
    return times;
  }

  [[nodiscard]] std::string table_size() const {
    return database_.value("SELECT pg_size_pretty(pg_total_relation_size('loopscope.schedule'))");
  }

 private:
  std::vector<storage::ClaimedLoop> claim(Times& times) {
    return timed(times.claim, [&] { return results_->claim_due("bench/1/0", 60.0, kBatch); });
  }
  void finish(const std::vector<storage::ClaimedLoop>& claims, std::int64_t due_us, Times& times) {
    std::vector<storage::CompletedLoop> done;
    for (const storage::ClaimedLoop& claim : claims)
      done.push_back(
          {claim.loop.loop_id, claim.fence, claim.database_now_us, due_us, std::nullopt});
    timed(times.finish, [&] { return results_->finish(done, {}); });
  }
  /// What the rest of the process asks at every poll, and `once`.
  void look(std::int64_t due_us, Times& times) {
    timed(times.look_back, [&] { return results_->look_back(), 0; });
    timed(times.health, [&] { return results_->schedule_health(); });
    timed(times.recall, [&] { return results_->recall_stray(60.0); });
    constexpr int kClaims = 20;
    for (int k = 0; k < kClaims; ++k) {
      const auto claims = timed(times.claim_next, [&] {
        return results_->claim_next("bench/1/0", 60.0, kBatch,
                                    std::int64_t{k} * (loops_ / kClaims));
      });
      finish(claims, due_us, times);
    }
  }

  int loops_;
  TestDatabase database_;
  SqlConnection server_;
  std::optional<storage::ResultsDatabase> results_;
  double pause_s_;  ///< until the loops are due again: longer than a visit takes
};

struct Row {
  const char* what;
  std::vector<double> Times::*times;
};
constexpr Row kRows[] = {{"claim_due", &Times::claim},     {"finish", &Times::finish},
                         {"look_back", &Times::look_back}, {"schedule_health", &Times::health},
                         {"recall_stray", &Times::recall}, {"claim_next", &Times::claim_next}};

struct Run {
  Times all;   ///< of every period
  Times last;  ///< of the last one
  std::string size;
};

Run run(int loops, int periods, bool under_snapshot) {
  Plant plant(loops);
  plant.visit_all();  // the caches are warm, the planner's figures true
  if (under_snapshot) plant.hold_snapshot();
  Run result;
  for (int period = 0; period < periods; ++period) {
    result.last = plant.visit_all();
    for (const Row& row : kRows)
      std::ranges::copy(result.last.*row.times, std::back_inserter(result.all.*row.times));
  }
  result.size = plant.table_size();
  return result;
}

/// Whether the claims are within the bound.
bool print(const Run& undisturbed, const Run& disturbed) {
  std::printf("%-16s %10s %10s %10s %10s %7s %7s   last period: %7s %7s\n", "ms", "mean", "p99",
              "mean", "p99", "times", "times", "times", "times");
  bool holds = true;
  for (const Row& row : kRows) {
    const auto &calm = undisturbed.all.*row.times, &all = disturbed.all.*row.times,
               &last = disturbed.last.*row.times;
    const double means = mean(all) / mean(calm), ends = percentile_99(all) / percentile_99(calm);
    const double last_means = mean(last) / mean(calm);
    const double last_ends = percentile_99(last) / percentile_99(calm);
    std::printf("%-16s %10.3f %10.3f %10.3f %10.3f %7.2f %7.2f   %20.2f %7.2f\n", row.what,
                mean(calm), percentile_99(calm), mean(all), percentile_99(all), means, ends,
                last_means, last_ends);
    if (row.times == &Times::claim)
      holds = std::max({means, ends, last_means, last_ends}) <= kMostTimes;
  }
  std::printf("table with its indexes: %s, under the snapshot %s\n", undisturbed.size.c_str(),
              disturbed.size.c_str());
  return holds;
}

}  // namespace
}  // namespace loopscope::tests

int main(int argc, char** argv) {
  using namespace loopscope::tests;
  if (!test_server()) {
    std::fprintf(stderr, "claim_benchmark: %s\n", kNoServer);
    return 4;
  }
  const int loops = argc > 1 ? std::atoi(argv[1]) : 10'000;
  const int periods = argc > 2 ? std::atoi(argv[2]) : 20;
  std::printf("%d loops, %d periods; without an old snapshot, and under one\n", loops, periods);
  const Run undisturbed = run(loops, periods, false);
  const Run disturbed = run(loops, periods, true);
  return print(undisturbed, disturbed) ? 0 : 1;
}
