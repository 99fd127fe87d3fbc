#include "core/signal/between_rows.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/signal/order/order_statistic.hpp"
#include "core/signal/order/spread.hpp"

namespace loopscope::core::signal {
namespace {

/// What the grid explains, with room for signals that are not normal, and a hundredth for chance.
constexpr double kExplained = 3.0;
constexpr double kChance = 0.01;
/// With steps that are a larger share of the usual distance than this, a repetition says nothing.
constexpr double kCoarse = 0.3;
/// A value that is taken up so often and is the highest or lowest is a limit of the transmitter.
constexpr std::size_t kClippedRuns = 3;
/// The second difference of three values of a grid is within this many of its steps when they lie
/// on a line that was rounded to the grid.
constexpr double kRoundingSteps = 2.5;
/// Rounding of the line itself, relative to the values.
constexpr double kLineRounding = 1e-11;

/// Marks by a rule, and how many samples it could be asked of.
struct Marks {
  std::vector<bool> marked;
  std::size_t asked = 0;
  std::size_t count = 0;
  std::vector<double> others;  ///< distances of those that are not marked
};

double median_of(std::vector<double> values) {
  return values.empty() ? 0.0 : median(std::move(values));
}

/// Whether there are more marks than chance alone may explain, at whatever resolution.
bool worth_a_look(const Marks& marks) {
  return static_cast<double>(marks.count) > kChance * static_cast<double>(marks.asked);
}

/// More marks than values rounded to steps of `resolution` would show.
bool beyond_chance(const Marks& marks, double resolution) {
  const double usual = median_of(marks.others);
  if (marks.asked == 0 || !(resolution < kCoarse * usual)) return false;
  const double expected = kExplained * kNormalDensityAtZero * resolution / usual + kChance;
  return static_cast<double>(marks.count) > expected * static_cast<double>(marks.asked);
}

Samples without(Samples pv, const std::vector<bool>& marked) {
  for (std::size_t k = 0; k < pv.size(); ++k) {
    if (marked[k]) pv[k] = kMissing;
  }
  return pv;
}

/// Runs of samples of this value.
std::size_t runs_at(const Samples& pv, double value) {
  std::size_t runs = 0;
  for (std::size_t k = 0; k < pv.size(); ++k) {
    if (pv[k] == value && (k == 0 || pv[k - 1] != value)) ++runs;
  }
  return runs;
}

/// The values at which pv is clipped.
class Limits {
 public:
  Limits(const Samples& pv, const Spread& spread)
      : high_(runs_at(pv, spread.high) >= kClippedRuns ? spread.high : kMissing),
        low_(runs_at(pv, spread.low) >= kClippedRuns ? spread.low : kMissing) {}
  [[nodiscard]] bool at(double value) const { return value == high_ || value == low_; }

 private:
  double high_;
  double low_;
};

Marks mark_repeats(const Samples& pv, const Limits& limits) {
  Marks marks{std::vector<bool>(pv.size(), false), 0, 0, {}};
  marks.others.reserve(pv.size());
  for (std::size_t k = 1; k < pv.size(); ++k) {
    if (!std::isfinite(pv[k]) || !std::isfinite(pv[k - 1]) || limits.at(pv[k])) continue;
    ++marks.asked;
    marks.marked[k] = pv[k] == pv[k - 1];
    if (marks.marked[k]) {
      ++marks.count;
    } else {
      marks.others.push_back(std::abs(pv[k] - pv[k - 1]));
    }
  }
  return marks;
}

Marks mark_collinear(const Samples& pv, const Limits& limits, double tolerance) {
  Marks marks{std::vector<bool>(pv.size(), false), 0, 0, {}};
  marks.others.reserve(pv.size());
  for (std::size_t k = 1; k + 1 < pv.size(); ++k) {
    const double bend = std::abs(pv[k + 1] - 2.0 * pv[k] + pv[k - 1]);
    if (!std::isfinite(bend) || limits.at(pv[k])) continue;
    ++marks.asked;
    marks.marked[k] = bend <= tolerance;
    if (marks.marked[k]) {
      ++marks.count;
    } else {
      marks.others.push_back(bend);
    }
  }
  return marks;
}

}  // namespace

Samples without_repeats(const Samples& pv) {
  const std::optional<Spread> spread = measure_spread(pv);
  if (!spread || spread->constant()) return pv;
  const Marks marks = mark_repeats(pv, Limits(pv, *spread));
  if (!worth_a_look(marks) || !beyond_chance(marks, smallest_step(pv).value_or(0.0))) return pv;
  return without(pv, marks.marked);
}

Samples without_collinear(const Samples& pv) {
  const std::optional<Spread> spread = measure_spread(pv);
  if (!spread || spread->constant()) return pv;
  const Limits limits(pv, *spread);
  const double size = std::max(std::abs(spread->low), std::abs(spread->high));
  const auto tolerance_of = [size](std::optional<double> step) {
    return kRoundingSteps * step.value_or(0.0) + kLineRounding * size;
  };
  // A tolerance that is too wide marks more: where even so there are too few, none is looked for.
  const std::optional<double> at_most = smallest_neighbour_step(pv);
  if (at_most && !worth_a_look(mark_collinear(pv, limits, tolerance_of(at_most)))) return pv;
  const double tolerance = tolerance_of(smallest_step(pv));
  const Marks marks = mark_collinear(pv, limits, tolerance);
  if (!worth_a_look(marks) || !beyond_chance(marks, tolerance)) return pv;
  return without(pv, marks.marked);
}

}  // namespace loopscope::core::signal
