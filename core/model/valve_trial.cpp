#include "core/model/valve_trial.hpp"

#include <algorithm>
#include <utility>

namespace loopscope::core::model {
namespace {

constexpr double kNearBand = 0.1;  ///< in logarithms
/// Rows between corrections, about a cycle: twice the lags, so that a lane's effect is seen; short
/// enough that a slip missed in a slow cycle is not carried on.
constexpr double kFewestRowsBetween = 24.0;
constexpr double kMostRowsBetween = 64.0;

std::size_t stretch(double period, std::size_t samples_per_row) {
  const double cycle = period / static_cast<double>(samples_per_row);
  return static_cast<std::size_t>(std::clamp(cycle, kFewestRowsBetween, kMostRowsBetween));
}

}  // namespace

bool near_band(const Valve& a, const Valve& b) {
  return std::abs(std::log(a.stickband_percent / b.stickband_percent)) < kNearBand;
}

std::vector<Trial> leading(std::vector<Trial> trials, std::size_t count,
                           const std::function<bool(const Trial&)>& wanted) {
  std::ranges::sort(trials, better);
  std::vector<Trial> chosen;
  for (const Trial& trial : trials) {
    const bool taken = std::ranges::any_of(
        chosen, [&](const Trial& other) { return near_band(trial.valve, other.valve); });
    if (wanted(trial) && !taken && chosen.size() < count) {
      chosen.push_back(trial);
    }
  }
  return chosen;
}

bool fittable(const ValveRecords::Entry& entry) {
  return entry.record.rows.rows > 4 * kLaggedColumns && entry.record.linear_residual > 0.0;
}

double period_of(const ValveRecords& records, const Valve& valve) {
  return records.swings().period(valve.stickband_percent);
}

Trial judge(const ValveRecords& records, ValveRecords::Entry& entry, const Valve& valve,
            const LaggedModel& start, int passes) {
  Trial trial;
  trial.valve = valve;
  trial.samples_per_row = entry.samples_per_row;
  const double scale = static_cast<double>(records.samples()) / static_cast<double>(entry.samples);
  const std::size_t rows = stretch(period_of(records, valve), entry.samples_per_row);
  LaggedModel model = start;
  for (int pass = 0; pass < passes && fittable(entry); ++pass) {
    TrackedValve tracked = track_valve(entry.record, valve, model, rows);
    model = tracked.model;
    const double evidence = scale * tracked.evidence;
    if (evidence <= trial.evidence) {
      break;
    }
    trial.evidence = evidence;
    trial.tracked = std::move(tracked);
  }
  if (trial.evidence > entry.evidence) {
    entry.evidence = trial.evidence;
    entry.model = trial.tracked.model;
  }
  return trial;
}

}  // namespace loopscope::core::model
