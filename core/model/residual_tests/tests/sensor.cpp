#include "core/model/residual_tests/tests/sensor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/hos/numeric/distributions.hpp"
#include "core/model/residual_tests/statistics/renewals.hpp"
#include "core/model/residual_tests/statistics/tails.hpp"
#include "core/model/residual_tests/statistics/value_grid.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

/// On a grid of 0.15 of the fast noise 0.15 / sqrt(4 pi) = 4 % of the samples repeat the one
/// before; twice that for noise with a peak in the middle.
constexpr double kRepeatsByGrid = 0.09;
constexpr double kHoldLooks = 3.0;

struct Hold {
  double p = 1.0;
  double samples = 1.0;
  std::optional<std::size_t> at_sample;
  const char* words = "";
};

double covered(const std::vector<FlatRun>& runs) {
  double samples = 0.0;
  for (const FlatRun& run : runs) samples += static_cast<double>(run.samples);
  return samples;
}

/// Normal deviate of a count of repeats among the samples, as a p.
Hold by_repeats(const std::vector<FlatRun>& runs, double grid_step, double noise_std) {
  const double samples = covered(runs);
  if (samples <= 0.0 || grid_step >= kHarmlessStep * noise_std) return {};
  const double repeats = samples - static_cast<double>(runs.size());
  const double expected = kRepeatsByGrid * samples;
  const double z = (repeats - expected) / std::sqrt(expected * (1.0 - kRepeatsByGrid));
  const double p = hos::normal_upper(z);
  return {p, samples / static_cast<double>(runs.size()), std::nullopt, "pv is renewed only every "};
}

bool op_moves_within(const FlatRun& run, const ResidualView& view, double op_std) {
  const auto op = view.op_percent.subspan(run.begin, run.samples);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double value : op) {
    low = std::fmin(low, value);
    high = std::fmax(high, value);
  }
  return high - low > op_std;
}

/// Runs of equal values have an exponential tail where each sample renews by chance.
Hold by_freeze(const std::vector<FlatRun>& runs, const ResidualContext& context) {
  if (!context.op || runs.size() < 20) return {};
  const auto longest =
      std::max_element(runs.begin(), runs.end(),
                       [](const FlatRun& a, const FlatRun& b) { return a.samples < b.samples; });
  if (longest->samples < 10 || !op_moves_within(*longest, context.view, context.op->std)) return {};
  const double share = static_cast<double>(longest->samples) / covered(runs);
  return {largest_share_upper(share, runs.size()), static_cast<double>(longest->samples),
          longest->begin, "pv stands still while op moves, for "};
}

Hold by_clock(const std::vector<FlatRun>& runs) {
  const Clock clock = find_clock(runs);
  return {clock.p, static_cast<double>(clock.period_samples), std::nullopt,
          "pv is renewed by a clock, every "};
}

Hold strongest(const ResidualContext& context) {
  const double noise_std = context.fast_noise_std;
  const std::vector<FlatRun> runs = complete_runs(context.view.pv, kSameValue * noise_std);
  return std::min(
      {by_clock(runs), by_repeats(runs, context.grid.step, noise_std), by_freeze(runs, context)},
      [](const Hold& a, const Hold& b) { return a.p < b.p; });
}

}  // namespace

std::optional<TestOutcome> test_grid(const ResidualContext& context) {
  if (!context.pv) return std::nullopt;
  const double noise_std = context.fast_noise_std;
  const ValueGrid& grid = context.grid;
  const bool coarse = grid.step >= kHarmlessStep * noise_std;
  TestOutcome answer{{"grid", coarse ? grid.p : 1.0, {}}, {}};
  if (answer.question.p > kSignificant) return answer;
  answer.question.statement = "pv moves in steps of " + text::units_of_pv(grid.step) + " (" +
                              std::to_string(grid.levels) + " values), " +
                              text::number(grid.step / noise_std) + " times its fast noise.";
  answer.nominations = {
      {.effect = EffectKind::sensor_quantisation, .p = grid.p, .step = grid.step}};
  return answer;
}

std::optional<TestOutcome> test_held(const ResidualContext& context) {
  if (!context.pv) return std::nullopt;
  const Hold hold = strongest(context);
  TestOutcome answer{{"held", std::min(1.0, kHoldLooks * hold.p), {}}, {}};
  if (answer.question.p > kSignificant) return answer;
  const double interval_s = context.view.sample_interval_s;
  answer.question.statement = hold.words + text::number(hold.samples) + " samples (" +
                              text::duration(hold.samples * interval_s) + ")";
  if (hold.at_sample)
    answer.question.statement += ", " + text::at_place(*hold.at_sample, interval_s);
  answer.question.statement += ".";
  answer.nominations = {{.effect = EffectKind::sensor_hold,
                         .p = hold.p,
                         .at_sample = hold.at_sample,
                         .hold_samples = hold.samples}};
  return answer;
}

}  // namespace loopscope::core::model
