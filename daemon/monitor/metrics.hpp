#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "storage/results/leases/schedule_health.hpp"
#include "storage/results/plant/plant_figures.hpp"
#include "storage/results/results_database.hpp"
#include "storage/stage_cost.hpp"

namespace loopscope::daemon {

/// Which program this is: the labels of loopscope_build_info.
struct BuildInfo {
  std::string version;
  int algorithm_revision = 0;
  std::string path;  ///< core::hos::processor_path()
};

/// A clock beside the results server's.
struct ClockFigure {
  std::string clock;     ///< results, host, historian NAME
  double ahead_s = 0.0;  ///< of the results server's
  bool is_wrong = false;
};

/// The figures of this process for Prometheus (README, "Monitoring": each name, its unit and what
/// it means). Nothing here is per loop: a catalogue of a hundred thousand loops would be as many
/// series; single loops are asked for in SQL. What is not known yet is left out instead of said to
/// be 0. What is counted is handed in as what came since the last call. Thread-safe; a call takes a
/// lock and some hundred nanoseconds.
class Metrics {
 public:
  /// One for each process: its time of construction is loopscope_start_time_seconds.
  explicit Metrics(const BuildInfo& build);
  ~Metrics();
  Metrics(const Metrics&) = delete;
  Metrics& operator=(const Metrics&) = delete;

  /// The historians of the settings in force: their counters begin at 0, so that a first event is
  /// seen as an increase, and the age of data of others is forgotten.
  void set_sources(std::span<const std::string> sources);

  void count(const storage::WriteCount& count);
  void add(const storage::StageCost& cost);
  /// A batch of loops took so long from its claim to its end.
  void observe_batch(double seconds);
  void leases_lost(std::size_t loops);

  /// A new connection took the place of a broken one; `target` is "results" or "historian NAME".
  void reconnected(const std::string& target);
  /// The fault of `subject` stands. It is counted when it begins, however many threads meet it.
  void fault(const std::string& subject);
  void recovered(const std::string& subject);

  /// A row of the historian `source` is so old, by the historian's clock. Shown is the age of the
  /// newest row that was ever seen, as it grows.
  void data_age(const std::string& source, double seconds);
  void unknown_quality(const std::string& source, std::size_t values);

  /// `retention_months`: what the settings keep, 0 = all.
  void set(const storage::ScheduleHealth& health, int retention_months);
  void set(const storage::PlantFigures& figures);
  /// All clocks that were compared; others are forgotten.
  void set_clocks(std::span<const ClockFigure> clocks);
  /// Windows that are kept in memory (WindowCache), and what they take.
  void kept_windows(std::size_t loops, std::size_t bytes);
  void settings_reload(bool success);
  /// Of the thread that stands still longest.
  void since_progress(double seconds);

  /// All of it in Prometheus' text format 0.0.4.
  [[nodiscard]] std::string text() const;
  static constexpr const char* kContentType = "text/plain; version=0.0.4; charset=utf-8";

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// For how long the results database has kept the same oldest snapshot for somebody, as far as this
/// process has seen: PostgreSQL tells which one it is, not since when.
class OldestSnapshot {
 public:
  using Clock = std::chrono::steady_clock;

  /// `transaction`: of storage::ScheduleHealth; empty = none is kept. Seconds.
  double seconds_kept(const std::string& transaction, Clock::time_point now) {
    if (std::exchange(transaction_, transaction) != transaction) since_ = now;
    return transaction.empty() ? 0.0 : std::chrono::duration<double>(now - since_).count();
  }

 private:
  std::string transaction_;
  Clock::time_point since_;
};

}  // namespace loopscope::daemon
