#include "core/signal/stand_still.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/signal/control_state.hpp"
#include "core/signal/op_scale.hpp"
#include "core/signal/order/order_statistic.hpp"
#include "core/signal/order/spread.hpp"
#include "core/signal/setpoint_moves.hpp"

namespace loopscope::core::signal {
namespace {

/// Half of the run, as in data of which most say so.
constexpr double kMostOfRun = 0.5;
/// What a window tells the next fades by half in a hundred and forty of them: a transmitter that
/// was replaced, or a calm month, is forgotten.
constexpr double kKept = 0.995;
/// The smallest steps of an archive that stores by a dead band are exceptions (start, quality).
constexpr double kSmallSteps = 0.05;

/// The step by which pv moves where it moves: that of its grid, or of its dead band. nullopt where
/// it does not move.
std::optional<double> usual_step(std::span<const double> pv) {
  std::vector<double> steps;
  steps.reserve(pv.size());
  double before = kMissing;
  for (const double value : pv) {
    if (!std::isfinite(value)) continue;
    const double step = std::abs(value - before);
    if (step > 0.0) steps.push_back(step);
    before = value;
  }
  if (steps.empty()) return std::nullopt;
  const auto place = static_cast<std::size_t>(kSmallSteps * static_cast<double>(steps.size()));
  return order_statistic(steps, place);
}

/// Of a value that never moved: the last of its decimals, as people and converters write them.
double decimals_of(double value) {
  constexpr int kMostDecimals = 6;
  double step = 1.0;
  for (int k = 0; k < kMostDecimals; ++k, step /= 10.0) {
    const double steps = value / step;
    if (std::abs(steps - std::round(steps)) <= 1e-9 * std::max(1.0, std::abs(steps))) break;
  }
  return step;
}

std::optional<double> smaller(std::optional<double> a, std::optional<double> b) {
  if (!a || !b) return a ? a : b;
  return std::min(*a, *b);
}

double step_of(const RecordedLoop& loop, const FlatRun& run) {
  const auto past =
      loop.past && loop.past->step > 0.0 ? std::optional(loop.past->step) : std::nullopt;
  return smaller(usual_step(loop.pv), past).value_or(decimals_of(run.value));
}

template <typename Value>
std::span<const Value> part(std::span<const Value> series, const FlatRun& run) {
  return series.empty() ? series : series.subspan(run.first, run.samples);
}

bool is_most_of(const FlatRun& run, std::size_t samples) {
  return static_cast<double>(samples) > kMostOfRun * static_cast<double>(run.samples);
}

/// An operator moves the output now and then, a controller all the time.
bool is_at_work(std::span<const double> op) {
  constexpr double kShareOfMoves = 0.05;
  return share_of_moves(op) > kShareOfMoves;
}

/// By the mode where it is recorded, else by op.
bool in_automatic(const RecordedLoop& loop, const FlatRun& run) {
  const ModeCounts modes = count_modes(part(loop.mode, run));
  if (modes.known() == 0 || is_most_of(run, modes.unknown)) return is_at_work(part(loop.op, run));
  return is_most_of(run, modes.automatic);
}

/// A controller that has wound up is in automatic, recorded or not.
bool wound_up(const RecordedLoop& loop, const FlatRun& run) {
  return loop.op_in_percent && fraction_at_limit(part(loop.op, run)).value_or(0.0) > kMostOfRun;
}

bool in_manual(const RecordedLoop& loop, const FlatRun& run) {
  return is_most_of(run, count_modes(part(loop.mode, run)).manual);
}

std::vector<double> error_in(const RecordedLoop& loop, const FlatRun& run) {
  std::vector<double> error;
  for (const double sp : part(loop.sp, run)) {
    if (std::isfinite(sp)) error.push_back(sp - run.value);
  }
  return error;
}

/// `run` up to a move of the setpoint within its last stretch: the controller answers it at once,
/// pv behind its dead time. Where sp moves most of the time (cascade, ratio) nothing is left out.
FlatRun without_late_setpoint(const RecordedLoop& loop, const FlatRun& run) {
  const auto sp = part(loop.sp, run);
  if (moves_most_of_the_time(sp)) return run;
  const std::vector<SetpointMove> moves = find_setpoint_moves(sp);
  const auto late = std::ranges::find_if(moves, [&](const SetpointMove& move) {
    return run.samples - move.first < kFewestFlatSamples;
  });
  FlatRun judged = run;
  if (late != moves.end()) judged.samples = late->first;
  return judged;
}

/// `judged`: the part of `run` in which op and error are looked at.
StandStill described(const RecordedLoop& loop, const FlatRun& run, const FlatRun& judged) {
  StandStill still{.run = run};
  const auto is_recorded = [](double value) { return std::isfinite(value); };
  const auto before = loop.pv.first(run.first);
  const auto behind = loop.pv.subspan(run.end());
  still.to_the_end = std::ranges::none_of(behind, is_recorded);
  still.whole = still.to_the_end && std::ranges::none_of(before, is_recorded);
  const auto op = part(loop.op, judged);
  still.op_moves = moves_beyond_noise(op, smallest_neighbour_step(loop.op).value_or(0.0));
  if (const auto spread = measure_spread(op)) {
    still.op_low = spread->low;
    still.op_high = spread->high;
  }
  const std::vector<double> error = error_in(loop, judged);
  if (!error.empty()) still.error = median(error);
  // What a coarse grid hides is less than a step, and no controller winds up for it.
  still.error_lasts = wound_up(loop, judged)
                          ? keeps_its_sign(error)
                          : in_automatic(loop, judged) && keeps_its_sign(error, step_of(loop, run));
  return still;
}

/// A wandering op alone shows that a loop lives where it moves by more than a positioner's
/// tolerance.
bool is_noticed(const RecordedLoop& loop, const StandStill& still) {
  constexpr double kLeastMove_percent = 0.5;
  if (still.error_lasts) return true;
  return still.op_moves &&
         (!loop.op_in_percent || still.op_high - still.op_low >= kLeastMove_percent);
}

}  // namespace

std::optional<StandStill> find_stand_still(const RecordedLoop& loop) {
  std::vector<FlatRun> runs = flat_runs(loop.pv);
  std::erase_if(runs, [&](const FlatRun& run) { return in_manual(loop, run); });
  const double before = loop.past ? loop.past->longest_flat_s / loop.sample_interval_s : 0.0;
  for (auto run = runs.rbegin(); run != runs.rend(); ++run) {
    if (!is_unusually_long(*run, runs, before)) continue;
    const FlatRun judged = without_late_setpoint(loop, *run);
    if (judged.samples < kFewestFlatSamples) continue;
    const StandStill still = described(loop, *run, judged);
    if (is_noticed(loop, still)) return still;
  }
  return std::nullopt;
}

PvPast past_with(const RecordedLoop& loop) {
  PvPast past = loop.past.value_or(PvPast{});
  past.longest_flat_s *= kKept;
  const auto is_recorded = [](double value) { return std::isfinite(value); };
  const auto first = std::ranges::find_if(loop.pv, is_recorded) - loop.pv.begin();
  const auto last = std::ranges::find_if(loop.pv.rbegin(), loop.pv.rend(), is_recorded);
  const auto end = static_cast<std::size_t>(loop.pv.rend() - last);
  const std::vector<FlatRun> runs = flat_runs(loop.pv);
  for (const FlatRun& run : runs) {
    const bool cut = run.first == static_cast<std::size_t>(first) || run.end() == end;
    if (cut || in_manual(loop, run) || is_unusually_long(run, runs)) continue;
    past.longest_flat_s =
        std::max(past.longest_flat_s, static_cast<double>(run.samples) * loop.sample_interval_s);
  }
  const auto known = past.step > 0.0 ? std::optional(past.step) : std::nullopt;
  past.step = smaller(usual_step(loop.pv), known).value_or(0.0);
  return past;
}

}  // namespace loopscope::core::signal
