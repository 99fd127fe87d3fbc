#include "daemon/monitor/metrics.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>
#include <sstream>
#include <vector>

#include "daemon/monitor/labelled_family.hpp"
#include "daemon/monitor/plant_metrics.hpp"

namespace loopscope::daemon {
namespace {

using Clock = std::chrono::steady_clock;
using prometheus::Counter;
using prometheus::Family;
using prometheus::Gauge;
using prometheus::Histogram;
using prometheus::Registry;

Family<Counter>& counters(Registry& registry, const char* name, const char* help) {
  return prometheus::BuildCounter().Name(name).Help(help).Register(registry);
}

Family<Gauge>& gauges(Registry& registry, const char* name, const char* help) {
  return prometheus::BuildGauge().Name(name).Help(help).Register(registry);
}

Family<Histogram>& histograms(Registry& registry, const char* name, const char* help) {
  return prometheus::BuildHistogram().Name(name).Help(help).Register(registry);
}

double seconds_since_1970(std::chrono::system_clock::time_point time) {
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

/// A batch of unchanged loops takes tens of milliseconds, one of models of long windows minutes.
const Histogram::BucketBoundaries kBatchSeconds{0.05, 0.1, 0.25, 0.5, 1.0,   2.5,
                                                5.0,  10., 25.,  60., 120.0, 300.0};

}  // namespace

struct Metrics::Impl {
  mutable std::mutex mutex;  // of what grows: the registry's own locks do not span two of its calls
  Registry registry;

  Family<Counter>& loops =
      counters(registry, "loopscope_loops_total", "Loops brought to their end, by what came of it");
  Family<Counter>& stages = counters(registry, "loopscope_stage_seconds_total",
                                     "Time of the worker threads by stage, summed over threads");
  Family<Histogram>& batches =
      histograms(registry, "loopscope_batch_seconds", "Time from the claim of a batch to its end");
  Family<Counter>& values =
      counters(registry, "loopscope_sample_values_total", "Values in the windows that were read");
  Family<Counter>& leases =
      counters(registry, "loopscope_leases_lost_total", "Claimed loops that were lost to others");
  Family<Gauge>& enabled =
      gauges(registry, "loopscope_enabled_loops", "Enabled loops of the catalogue");
  Family<Gauge>& overdue =
      gauges(registry, "loopscope_overdue_loops", "Enabled loops that are due and held by nobody");
  Family<Gauge>& lag =
      gauges(registry, "loopscope_lag_seconds", "Age of the most overdue loop; 0 = none is");
  Family<Gauge>& failing =
      gauges(registry, "loopscope_failing_loops", "Enabled loops whose last analysis failed");
  Family<Gauge>& months = gauges(registry, "loopscope_partition_months_ahead",
                                 "Months after the running one that have their partitions");
  Family<Gauge>& default_rows =
      gauges(registry, "loopscope_default_partition_rows",
             "Rows in DEFAULT partitions, counted up to 10001; 0 is healthy");
  Family<Gauge>& oldest = gauges(registry, "loopscope_oldest_partition_months",
                                 "Months from the oldest partition to the running one");
  Family<Gauge>& snapshot = gauges(
      registry, "loopscope_oldest_snapshot_seconds",
      "Since this process first saw the oldest snapshot that the results database still keeps");
  Family<Gauge>& retention =
      gauges(registry, "loopscope_retention_months", "Months that the settings keep; 0 = all");
  Family<Gauge>& progress = gauges(registry, "loopscope_seconds_since_progress",
                                   "Since the thread that stands still longest advanced");
  Family<Gauge>& kept_loops = gauges(registry, "loopscope_kept_windows",
                                     "Loops whose window is kept, so that new rows are read only");
  Family<Gauge>& kept_bytes =
      gauges(registry, "loopscope_kept_windows_bytes", "Memory that these windows take");
  Family<Gauge>& reload = gauges(registry, "loopscope_settings_reload_success",
                                 "1 = the last reading of the settings was in order, 0 = it failed "
                                 "and the old ones are in force");

  std::map<std::string, Clock::time_point> newest_row;  ///< of each source
  LabelledFamily<Gauge> data_age{
      gauges(registry, "loopscope_data_age_seconds", "Age of the newest row of a historian"),
      "source"};
  LabelledFamily<Counter> reconnects{
      counters(registry, "loopscope_reconnects_total", "Connections made in place of broken ones"),
      "target"};
  LabelledFamily<Counter> faults{
      counters(registry, "loopscope_faults_total", "Faults that began, by what they are of"),
      "subject"};
  LabelledFamily<Gauge> standing{
      gauges(registry, "loopscope_fault_standing", "1 = the fault stands, 0 = it has ended"),
      "subject"};
  LabelledFamily<Gauge> clock_ahead{
      gauges(registry, "loopscope_clock_ahead_seconds",
             "Clock beside that of the results server; negative = behind"),
      "clock"};
  LabelledFamily<Gauge> clock_wrong{
      gauges(registry, "loopscope_clock_wrong",
             "1 = the clock differs from two others, or (results) nobody confirms it"),
      "clock"};
  LabelledFamily<Counter> unknown_quality{
      counters(registry, "loopscope_unknown_quality_total",
               "Values whose quality code nobody has explained; they count as bad"),
      "source"};

  PlantMetrics plant{registry};
  OldestSnapshot oldest_snapshot;

  void know_subject(const std::string& subject) {
    faults.at(subject);
    standing.at(subject);
  }
};

Metrics::Metrics(const BuildInfo& build) : impl_(std::make_unique<Impl>()) {
  gauges(impl_->registry, "loopscope_build_info", "Always 1; the labels say which program this is")
      .Add({{"version", build.version},
            {"algorithm_revision", std::to_string(build.algorithm_revision)},
            {"path", build.path}})
      .Set(1.0);
  gauges(impl_->registry, "loopscope_start_time_seconds",
         "When this process began, seconds since 1970; another one is another process")
      .Add({})
      .Set(seconds_since_1970(std::chrono::system_clock::now()));
  count({});
  add({});
  leases_lost(0);
  settings_reload(true);
  set_sources({});
}

Metrics::~Metrics() = default;

void Metrics::set_sources(std::span<const std::string> sources) {
  const std::lock_guard lock(impl_->mutex);
  impl_->data_age.keep(sources);
  std::erase_if(impl_->newest_row, [&](const auto& entry) {
    return std::ranges::find(sources, entry.first) == sources.end();
  });
  impl_->reconnects.at("results");
  impl_->know_subject("results database");
  for (const std::string& source : sources) {
    impl_->reconnects.at("historian " + source);
    impl_->know_subject("historian " + source);
    impl_->unknown_quality.at(source);
  }
}

void Metrics::count(const storage::WriteCount& count) {
  const auto grow = [&](const char* result, std::size_t loops) {
    impl_->loops.Add({{"result", result}}).Increment(static_cast<double>(loops));
  };
  grow("new", count.inserted);
  grow("revised", count.revised);
  grow("unchanged", count.unchanged);
  grow("set_aside", count.failed);
  grow("fenced_off", count.fenced_off);
  grow("not_judged", count.not_judged);
}

void Metrics::add(const storage::StageCost& cost) {
  const auto grow = [&](const char* stage, double seconds) {
    impl_->stages.Add({{"stage", stage}}).Increment(seconds);
  };
  grow("claim", cost.claim_s);
  grow("fetch", cost.fetch_s);
  grow("prepare", cost.prepare_s);
  grow("statistics", cost.statistics_s);
  grow("model", cost.model_s);
  grow("decide", cost.decide_s);
  grow("write", cost.write_s);
  grow("wait", cost.wait_s);
  impl_->values.Add({}).Increment(static_cast<double>(cost.values));
}

void Metrics::observe_batch(double seconds) {
  impl_->batches.Add({}, kBatchSeconds).Observe(seconds);
}

void Metrics::leases_lost(std::size_t loops) {
  impl_->leases.Add({}).Increment(static_cast<double>(loops));
}

void Metrics::reconnected(const std::string& target) {
  const std::lock_guard lock(impl_->mutex);
  impl_->reconnects.at(target).Increment();
}

void Metrics::fault(const std::string& subject) {
  const std::lock_guard lock(impl_->mutex);
  Gauge& standing = impl_->standing.at(subject);
  if (standing.Value() > 0.0) return;
  standing.Set(1.0);
  impl_->faults.at(subject).Increment();
}

void Metrics::recovered(const std::string& subject) {
  const std::lock_guard lock(impl_->mutex);
  impl_->standing.at(subject).Set(0.0);
}

void Metrics::data_age(const std::string& source, double seconds) {
  const std::lock_guard lock(impl_->mutex);
  const auto born = Clock::now() - std::chrono::duration_cast<Clock::duration>(
                                       std::chrono::duration<double>(seconds));
  const auto [newest, is_first] = impl_->newest_row.try_emplace(source, born);
  if (!is_first) newest->second = std::max(newest->second, born);
}

void Metrics::set_clocks(std::span<const ClockFigure> clocks) {
  const std::lock_guard lock(impl_->mutex);
  std::vector<std::string> names;
  names.reserve(clocks.size());
  for (const ClockFigure& clock : clocks) {
    names.push_back(clock.clock);
    impl_->clock_ahead.at(clock.clock).Set(clock.ahead_s);
    impl_->clock_wrong.at(clock.clock).Set(clock.is_wrong ? 1.0 : 0.0);
  }
  impl_->clock_ahead.keep(names);
  impl_->clock_wrong.keep(names);
}

void Metrics::unknown_quality(const std::string& source, std::size_t values) {
  const std::lock_guard lock(impl_->mutex);
  impl_->unknown_quality.at(source).Increment(static_cast<double>(values));
}

void Metrics::set(const storage::ScheduleHealth& health, int retention_months) {
  impl_->enabled.Add({}).Set(static_cast<double>(health.enabled_loops));
  impl_->overdue.Add({}).Set(static_cast<double>(health.overdue_loops));
  impl_->lag.Add({}).Set(health.lag_s);
  impl_->failing.Add({}).Set(static_cast<double>(health.failing_loops));
  impl_->months.Add({}).Set(static_cast<double>(health.partition_months_ahead));
  impl_->default_rows.Add({}).Set(static_cast<double>(health.default_partition_rows));
  impl_->oldest.Add({}).Set(static_cast<double>(health.oldest_partition_months));
  impl_->retention.Add({}).Set(static_cast<double>(retention_months));
  const std::lock_guard lock(impl_->mutex);
  impl_->snapshot.Add({}).Set(
      impl_->oldest_snapshot.seconds_kept(health.oldest_snapshot, Clock::now()));
}

void Metrics::set(const storage::PlantFigures& figures) {
  const std::lock_guard lock(impl_->mutex);
  impl_->plant.set(figures);
}

void Metrics::kept_windows(std::size_t loops, std::size_t bytes) {
  impl_->kept_loops.Add({}).Set(static_cast<double>(loops));
  impl_->kept_bytes.Add({}).Set(static_cast<double>(bytes));
}

void Metrics::settings_reload(bool success) {
  impl_->reload.Add({}).Set(success ? 1.0 : 0.0);
}

void Metrics::since_progress(double seconds) {
  impl_->progress.Add({}).Set(seconds);
}

std::string Metrics::text() const {
  // To the end: no scrape sees the figures of the plant while they are exchanged.
  const std::lock_guard lock(impl_->mutex);
  const auto now = Clock::now();
  for (const auto& [source, born] : impl_->newest_row)
    impl_->data_age.at(source).Set(std::chrono::duration<double>(now - born).count());
  std::ostringstream text;
  prometheus::TextSerializer().Serialize(text, impl_->registry.Collect());
  return text.str();
}

}  // namespace loopscope::daemon
