#include "core/signal/control_state.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

#include "core/signal/flat_run.hpp"
#include "core/signal/op_scale.hpp"
#include "core/signal/order/order_statistic.hpp"
#include "core/signal/order/spread.hpp"
#include "core/signal/read_back.hpp"

namespace loopscope::core::signal {
namespace {

/// Noise crosses zero now and then even where the mean error is one and a third of its standard
/// deviations.
constexpr double kSameSide = 0.9;

/// With the loop open for most of the window there is no control to judge.
constexpr double kMostOfWindow = 0.5;
/// An output that only touches its end is there for fewer samples.
constexpr std::size_t kFewestHeld = 10;

/// `no_against_mode`: op says so plainly enough to doubt a mode that says automatic.
enum class Acting : std::uint8_t { yes, no_by_mode, no_by_output, no_against_mode, unknown };

bool lasting_at_end(const ControlRecord& record, const FlatRun& run) {
  return record.range != RangeSource::unknown && at_end(run.value) &&
         keeps_its_sign(record.error.subspan(run.first, run.samples));
}

/// An operator moves the output a few times a shift. Far below what stand_still.cpp takes for a
/// controller at work: between the two an output alone says neither.
bool is_moved_by_hand(const ControlRecord& record) {
  constexpr double kFewMoves = 0.005;
  return share_of_moves(record.op_percent) < kFewMoves;
}

/// An output of few values may rest within one of its steps for long, with a controller at work (50
/// of 3000 calm loops do, tests/core/signal/state_rates_test.cpp).
bool has_many_values(std::span<const double> op) {
  constexpr double kFewestSteps = 10.0;
  const auto spread = measure_spread(op);
  const auto step = smallest_neighbour_step(op);
  return spread && step && spread->high - spread->low >= kFewestSteps * *step;
}

/// Integral action moves the output under an error that changes its sign, or away from its end.
/// Where no range is known a lasting error may be that of an output at its end.
bool should_move(const ControlRecord& record, const FlatRun& run) {
  return has_many_values(record.op_percent) &&
         (record.range != RangeSource::unknown ||
          !keeps_its_sign(record.error.subspan(run.first, run.samples)));
}

/// An error that stands asks nothing of its controller, whatever it was before.
bool stands(std::span<const double> error) {
  constexpr double kNearlyAll = 0.9;
  std::vector<double> recorded;
  std::ranges::copy_if(error, std::back_inserter(recorded),
                       [](double value) { return std::isfinite(value); });
  if (recorded.empty()) return true;
  const auto same = static_cast<double>(std::ranges::count(recorded, median(recorded)));
  return same >= kNearlyAll * static_cast<double>(recorded.size());
}

/// Whether somebody acts while op stands: not where op usually moves, or is moved by hand.
Acting acting_in(const ControlRecord& record, const FlatRun& run, std::span<const FlatRun> runs) {
  if (!is_long(run) || lasting_at_end(record, run)) return Acting::yes;
  if (stands(record.error.subspan(run.first, run.samples))) return Acting::yes;
  if (is_unusually_long(run, runs) && should_move(record, run)) return Acting::no_against_mode;
  return is_moved_by_hand(record) ? Acting::no_by_output : Acting::yes;
}

/// Half a percent about its middle, as much as positioners do not follow, and nobody's answer.
bool is_read_back(const ControlRecord& record, const Spread& op) {
  constexpr double kWidest_percent = 1.0;
  return record.range != RangeSource::unknown && op.high - op.low <= kWidest_percent &&
         is_read_back_noise(record.op_percent, record.error);
}

/// Whether the output is constant but for how it is read back, and not at its end.
bool stands_all_the_time(const ControlRecord& record, const std::optional<Spread>& op) {
  if (!op || (!op->constant() && !is_read_back(record, *op))) return false;
  const bool ended = record.range != RangeSource::unknown && (at_end(op->low) || at_end(op->high));
  return !ended || !keeps_its_sign(record.error);
}

/// `op`: spread of the output, nullopt = not recorded.
std::vector<Acting> by_output(const ControlRecord& record, const std::optional<Spread>& op) {
  if (stands_all_the_time(record, op))
    return std::vector(record.error.size(), Acting::no_against_mode);
  std::vector<Acting> acting(record.error.size(), op ? Acting::yes : Acting::unknown);
  const std::vector<FlatRun> runs = flat_runs(record.op_percent);
  for (const FlatRun& run : runs) {
    std::fill_n(acting.begin() + static_cast<std::ptrdiff_t>(run.first), run.samples,
                acting_in(record, run, runs));
  }
  return acting;
}

/// What a mode says goes before what op lets guess, unless op says otherwise plainly.
void put_modes(std::span<const ControlMode> mode, std::vector<Acting>& acting) {
  for (std::size_t k = 0; k < mode.size(); ++k) {
    if (mode[k] == ControlMode::unknown) continue;
    if (mode[k] == ControlMode::manual)
      acting[k] = Acting::no_by_mode;
    else if (acting[k] != Acting::no_against_mode)
      acting[k] = Acting::yes;
  }
}

bool is_lost(Acting acting) {
  return acting != Acting::yes && acting != Acting::unknown;
}

std::optional<std::size_t> lost_at(const std::vector<Acting>& acting) {
  std::optional<std::size_t> first;
  for (std::size_t k = acting.size(); k-- > 0 && acting[k] != Acting::yes;) {
    if (is_lost(acting[k])) first = k;
  }
  return first;
}

std::optional<double> at_limit(const ControlRecord& record) {
  switch (record.range) {
    case RangeSource::set:
      return fraction_at_limit(record.op_percent);
    case RangeSource::inferred:
      return fraction_held_at_limit(record.op_percent, record.error);
    case RangeSource::unknown:
      break;
  }
  return std::nullopt;
}

/// Of the last stretch of op at one end, with the error that it leaves.
std::optional<double> wound_up_percent(const ControlRecord& record) {
  if (record.range == RangeSource::unknown) return std::nullopt;
  constexpr double kMiddle = 50.0;
  std::size_t first = record.op_percent.size();
  double last = kMissing;
  for (std::size_t k = record.op_percent.size(); k-- > 0;) {
    const double value = record.op_percent[k];
    if (!std::isfinite(value)) continue;
    if (!at_end(value) ||
        (value < kMiddle) != (std::isfinite(last) ? last < kMiddle : value < kMiddle))
      break;
    last = value;
    first = k;
  }
  if (record.op_percent.size() - first < kFewestHeld) return std::nullopt;
  if (!keeps_its_sign(record.error.subspan(first))) return std::nullopt;
  return last < kMiddle ? 0.0 : 100.0;
}

}  // namespace

ModeCounts count_modes(std::span<const ControlMode> mode) {
  ModeCounts counts;
  for (const ControlMode sample : mode) {
    if (sample == ControlMode::manual)
      ++counts.manual;
    else if (sample == ControlMode::unknown)
      ++counts.unknown;
    else
      ++counts.automatic;
  }
  return counts;
}

bool keeps_its_sign(std::span<const double> error, double least) {
  std::size_t above = 0;
  std::size_t below = 0;
  std::size_t recorded = 0;
  for (const double value : error) {
    if (!std::isfinite(value)) continue;
    ++recorded;
    above += value > least ? 1 : 0;
    below += value < -least ? 1 : 0;
  }
  const double enough = kSameSide * static_cast<double>(recorded);
  return recorded > 0 && static_cast<double>(std::max(above, below)) >= enough;
}

bool ControlState::controlling() const {
  return acting_fraction.value_or(1.0) > kMostOfWindow;
}

ControlState find_control_state(const ControlRecord& record) {
  const std::optional<Spread> op = measure_spread(record.op_percent);
  std::vector<Acting> acting = by_output(record, op);
  put_modes(record.mode, acting);
  const auto count = [&](Acting which) {
    return static_cast<double>(std::ranges::count(acting, which));
  };
  const double by_mode = count(Acting::no_by_mode);
  const double by_op = count(Acting::no_by_output) + count(Acting::no_against_mode);
  const double told = by_mode + by_op + count(Acting::yes);
  ControlState state;
  if (told > 0.0) state.acting_fraction = count(Acting::yes) / told;
  if (by_mode + by_op > 0.0)
    state.reason = by_mode >= by_op ? NotActing::mode : NotActing::constant_output;
  state.lost_at = lost_at(acting);
  state.at_limit_fraction = at_limit(record);
  state.held_at_limit =
      state.at_limit_fraction.value_or(0.0) > kMostOfWindow && keeps_its_sign(record.error);
  state.wound_up_percent = wound_up_percent(record);
  return state;
}

}  // namespace loopscope::core::signal
