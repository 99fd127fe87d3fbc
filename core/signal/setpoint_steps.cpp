#include "core/signal/setpoint_steps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/signal/gaps.hpp"
#include "core/signal/order/order_statistic.hpp"
#include "core/signal/order/spread.hpp"
#include "core/signal/setpoint_moves.hpp"

namespace loopscope::core::signal {
namespace {

/// A step of half a standard deviation raises the mean square of the error by a quarter at first,
/// within what the error does by itself.
constexpr double kHiddenStep = 0.5;

/// Samples on which the error is judged settled: enough to know the median distance of white noise
/// within a fifth, and half a segment of the paper, so that a step costs one segment more than its
/// transient does.
constexpr std::size_t kGuard = 32;

/// The median distance of Gaussian values is 0.67 of their standard deviation; the double of it
/// leaves room for slow wandering and for 32 correlated samples.
constexpr double kSettled = 2.0 / kMadToSigma;

/// What has not settled after so long is a new level or a drift. A segment of 64 samples, its mean
/// removed, sees an eighth of it at most.
constexpr std::size_t kLongestTransient = 512;

/// With less than 40 % left, what is left is not the loop's usual state (prepare demands as much of
/// pv).
constexpr double kMostMasked = 0.6;

/// The error as it is away from steps.
struct Usual {
  double centre = 0.0;
  double std = 0.0;
};

std::vector<double> distances(std::span<const double> error, double centre) {
  std::vector<double> result;
  for (const double e : error) {
    if (std::isfinite(e)) result.push_back(std::abs(e - centre));
  }
  return result;
}

/// nullopt when the error is constant or not recorded.
std::optional<Usual> usual_error(const Samples& error) {
  const std::optional<Spread> spread = measure_spread(error);
  if (!spread || spread->constant()) return std::nullopt;
  Samples values = error;
  std::erase_if(values, [](double e) { return !std::isfinite(e); });
  const double centre = median(std::move(values));
  const double robust_std = kMadToSigma * median(distances(error, centre));
  // More than half of the values may be equal: a coarse sensor.
  return Usual{centre, robust_std > 0.0 ? robust_std : spread->std};
}

/// Finds where transients end, for moves in ascending time.
class Transients {
 public:
  Transients(std::span<const double> error, const Usual& usual) : error_(error), usual_(usual) {}

  /// One past the last sample that the transient of a move that ended at `from` may touch.
  std::size_t end(std::size_t from) {
    const std::size_t limit = std::min(error_.size(), from + kLongestTransient);
    // The samples up to back_ were found unsettled for an earlier move.
    back_ = std::max(from, back_);
    while (back_ < limit && !settled_at(back_)) ++back_;
    return std::min(limit, back_ + std::max(kGuard, back_ - from));
  }

 private:
  [[nodiscard]] bool settled_at(std::size_t k) const {
    const std::size_t length = std::min(kGuard, error_.size() - k);
    std::vector<double> off = distances(error_.subspan(k, length), usual_.centre);
    return off.empty() || median(std::move(off)) <= kSettled * usual_.std;
  }

  std::span<const double> error_;
  const Usual& usual_;
  std::size_t back_ = 0;
};

/// The moves that the error's own noise does not hide, and the one that may have come just before
/// the window where there are others.
std::vector<SetpointMove> steps_among(std::vector<SetpointMove> moves, const Usual& usual) {
  std::erase_if(moves, [&](const SetpointMove& move) {
    return std::abs(move.size) <= kHiddenStep * usual.std;
  });
  if (!moves.empty()) moves.insert(moves.begin(), {0, 0, kUnknownSize});
  return moves;
}

/// Makes the samples from the start of each step to `end(step)` missing.
template <typename End>
Samples without(Samples error, const std::vector<SetpointMove>& steps, End end) {
  for (const SetpointMove& step : steps) {
    const std::size_t after = std::min(end(step), error.size());
    for (std::size_t k = step.first; k < after; ++k) error[k] = kMissing;
  }
  return error;
}

/// Share of the recorded samples of `whole` that `masked` lacks.
double share_gone(const Samples& whole, const Samples& masked) {
  return 1.0 -
         static_cast<double>(count_recorded(masked)) / static_cast<double>(count_recorded(whole));
}

/// The whole error where more than kMostMasked would go.
ErrorBetweenSteps mask(const Samples& error, const std::vector<SetpointMove>& moves,
                       const Usual& usual) {
  const std::vector<SetpointMove> steps = steps_among(moves, usual);
  const std::size_t count = steps.empty() ? 0 : steps.size() - 1;
  const auto shortest = [](const SetpointMove& step) { return step.last + kGuard; };
  // Settles the case of a setpoint that never rests without a look at its transients.
  if (share_gone(error, without(error, steps, shortest)) > kMostMasked) return {error, count, 0.0};
  Transients transients(error, usual);
  const auto end = [&](const SetpointMove& step) { return transients.end(step.last); };
  Samples masked = without(error, steps, end);
  const double gone = share_gone(error, masked);
  return gone > kMostMasked ? ErrorBetweenSteps{error, count, 0.0}
                            : ErrorBetweenSteps{std::move(masked), count, gone};
}

}  // namespace

ErrorBetweenSteps error_between_steps(const PreparedLoop& loop) {
  const Samples& error = loop.drawable.error.empty() ? loop.error : loop.drawable.error;
  const std::vector<SetpointMove> moves = find_setpoint_moves(loop);
  if (moves.empty()) return {error, 0, 0.0};
  const std::optional<Usual> usual = usual_error(error);
  if (!usual) return {error, 0, 0.0};
  ErrorBetweenSteps first = mask(error, moves, *usual);
  if (first.masked_fraction <= 0.0) return first;
  // The transients widened what passed for usual: once more with what is left without them.
  const std::optional<Usual> calm = usual_error(first.error);
  return calm ? mask(error, moves, *calm) : first;
}

}  // namespace loopscope::core::signal
