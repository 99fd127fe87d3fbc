#include "tests/plants/process/recording.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace loopscope::tests::process {
namespace {

constexpr std::array kIntervals_s = {1.0, 2.0, 5.0, 10.0, 20.0, 30.0, 36.0, 60.0};
/// Longer records would take seconds to simulate.
constexpr double kMostSteps = 160000.0;

bool suits(double interval_s, std::size_t samples, double period_s, double step_s) {
  const double length_s = interval_s * static_cast<double>(samples);
  const double steps = interval_s / step_s;
  if (steps < 1.0 || std::abs(steps - std::round(steps)) > 1e-9) return false;
  if (length_s > kMostSteps * step_s) return false;
  if (period_s <= 0.0) return true;
  return period_s >= 6.0 * interval_s && period_s <= 120.0 * interval_s &&
         length_s >= 15.0 * period_s && length_s <= 600.0 * period_s;
}

/// About a third of the interval, of what historians offer.
double finer(double interval_s, double step_s) {
  double best = interval_s;
  for (const double candidate : kIntervals_s)
    if (candidate >= step_s && candidate * 2.0 <= interval_s) best = candidate;
  return std::remainder(best, step_s) == 0.0 ? best : interval_s;
}

void blank(ProcessLoop& loop, std::size_t from, std::size_t count) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (std::vector<double>* series : {&loop.sp, &loop.pv, &loop.op})
    for (std::size_t k = from; k < std::min(from + count, series->size()); ++k)
      (*series)[k] = kNone;
}

}  // namespace

std::optional<std::vector<Window>> draw_windows(const PlantPlan& plan, double period_s,
                                                Random& random) {
  const auto samples = static_cast<std::size_t>(random.log_uniform(1400.0, 4096.9));
  std::vector<double> fitting;
  for (const double interval_s : kIntervals_s)
    if (suits(interval_s, samples, period_s, plan.step_s)) fitting.push_back(interval_s);
  if (fitting.empty()) return std::nullopt;
  const double interval_s = fitting[random.below(fitting.size())];
  const bool flows_finer = random.chance(0.2);
  const bool ends_differ = random.chance(0.15);
  std::vector<Window> windows;
  for (const LoopPlan& loop : plan.loops) {
    const bool fine = flows_finer && loop.type == "flow";
    const double own_s = fine ? finer(interval_s, plan.step_s) : interval_s;
    const double early_s = ends_differ ? random.uniform(0.0, 240.0) : 0.0;
    windows.push_back(
        {samples, std::lround(own_s / plan.step_s), std::lround(early_s / plan.step_s)});
  }
  return windows;
}

void draw_gaps(std::vector<ProcessLoop>& loops, Random& random) {
  if (!random.chance(0.08)) return;
  const bool all = random.chance(0.5);
  const std::size_t one = random.below(loops.size());
  const std::size_t gaps = 1 + random.below(3);
  for (std::size_t gap = 0; gap < gaps; ++gap) {
    const double at = random.uniform(0.05, 0.9);
    const auto count = static_cast<std::size_t>(random.log_uniform(4.0, 60.0));
    for (std::size_t i = 0; i < loops.size(); ++i)
      if (all || i == one)
        blank(loops[i], static_cast<std::size_t>(at * static_cast<double>(loops[i].pv.size())),
              count);
  }
}

}  // namespace loopscope::tests::process
