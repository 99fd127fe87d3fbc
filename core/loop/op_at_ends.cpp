#include "core/loop/op_at_ends.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <vector>

namespace loopscope::core::loop {
namespace {

constexpr std::size_t kFewestForRests = 32;
constexpr double kNear = 1e-3;  ///< of the span
/// Two equal samples come by rounding at every turn of op.
constexpr std::size_t kShortestRun = 3;
constexpr std::size_t kFewestVisits = 2;
/// The last of the few values of a coarse sine holds up to 2.3 times as much as the next, that of
/// an op that wanders sometimes more.
constexpr double kTimesNext = 3.0;
/// An op that wanders between two to four values cannot be told from one with limits: of 510 sound
/// loops recorded in whole percent 30 pass the rule without this, one with it
/// (core/diagnosis/DECISIONS.md).
constexpr std::size_t kFewestValues = 5;

struct Runs {
  std::size_t samples = 0;
  std::size_t count = 0;
};

template <typename AtEnd>
Runs runs_where(const std::vector<double>& values, AtEnd at_end) {
  Runs runs;
  std::size_t length = 0;
  const auto close = [&] {
    if (length >= kShortestRun) {
      runs.samples += length;
      ++runs.count;
    }
    length = 0;
  };
  for (const double value : values) {
    if (at_end(value))
      ++length;
    else
      close();
  }
  close();
  return runs;
}

/// Whether op is at the end for much longer than at the value next to it (each within `near`): a
/// limit holds all that would lie beyond, an op that wanders or turns there is there for less.
bool piles_up(const std::vector<double>& depth, double near) {
  double next = std::numeric_limits<double>::infinity();
  // Far enough off for the two not to share a sample.
  for (const double value : depth)
    if (value > 3.0 * near) next = std::min(next, value);
  const auto count = [&](double from, double to) {
    return static_cast<double>(
        std::ranges::count_if(depth, [&](double v) { return v >= from && v <= to; }));
  };
  return count(0.0, near) > kTimesNext * count(next - near, next + near);
}

Runs rests_at(const std::vector<double>& depth, double near) {
  if (!piles_up(depth, near)) return {};
  return runs_where(depth, [&](double value) { return value <= near; });
}

/// Whether there are so many values, from `lowest` on, farther than `near` from the one below.
bool has_values(const std::vector<double>& values, double lowest, double near, std::size_t many) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  double last = lowest;
  for (std::size_t count = 1; count < many; ++count) {
    double next = kNone;
    for (const double value : values) next = value - last > near ? std::min(next, value) : next;
    if (next == kNone) return false;
    last = next;
  }
  return true;
}

std::vector<double> depth_of(const std::vector<double>& values, double end) {
  std::vector<double> depth;
  for (const double value : values) depth.push_back(std::abs(value - end));
  return depth;
}

}  // namespace

std::optional<OpAtEnds> measure_op_at_ends(std::span<const double> op) {
  std::vector<double> recorded;
  std::ranges::copy_if(op, std::back_inserter(recorded), [](double v) { return std::isfinite(v); });
  if (recorded.size() < kFewestForRests) return std::nullopt;
  const auto ends = std::ranges::minmax(recorded);
  const double near = kNear * (ends.max - ends.min);
  if (!(near > 0.0) || !has_values(recorded, ends.min, near, kFewestValues)) return std::nullopt;
  const Runs below = rests_at(depth_of(recorded, ends.min), near);
  const Runs above = rests_at(depth_of(recorded, ends.max), near);
  std::size_t resting = 0;
  for (const Runs& runs : {below, above}) resting += runs.count >= kFewestVisits ? runs.samples : 0;
  return OpAtEnds{static_cast<double>(resting) / static_cast<double>(recorded.size()),
                  static_cast<double>(std::max(below.count, above.count))};
}

}  // namespace loopscope::core::loop
