#include "core/signal/read_back.hpp"

#include <cmath>
#include <cstddef>

#include "core/signal/flat_run.hpp"
#include "core/signal/order/spread.hpp"

namespace loopscope::core::signal {
namespace {

/// A controller of a slower scan answers up to so many samples later.
constexpr std::size_t kLongestDelay = 3;
/// Standard errors of a correlation of independent series; of eight the largest passes it once in
/// 200 000.
constexpr double kStandardErrors = 5.0;
/// A rounded output answers with about one standard deviation of the error in each of its moves: n
/// of them are sqrt(n) standard errors, and twice what is asked for is plain.
constexpr double kFewestMoves = 100.0;

struct Sums {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
  void add(double a, double b) {
    if (!std::isfinite(a) || !std::isfinite(b)) return;
    n += 1.0;
    x += a;
    y += b;
    xx += a * a;
    yy += b * b;
    xy += a * b;
  }
  /// Correlation in standard errors; 0 where a series never moves.
  [[nodiscard]] double standard_errors() const {
    const double spread = (xx - x * x / n) * (yy - y * y / n);
    return spread > 0.0 ? std::sqrt(n / spread) * std::abs(xy - x * y / n) : 0.0;
  }
};

double count_moves(std::span<const double> op) {
  return share_of_moves(op) * static_cast<double>(op.size());
}

bool answers(std::span<const double> op, std::span<const double> error, std::size_t delay) {
  Sums by_level, by_step;
  for (std::size_t k = delay + 1; k < op.size(); ++k) {
    const double move = op[k] - op[k - 1];
    by_level.add(move, error[k - delay]);
    by_step.add(move, error[k - delay] - error[k - delay - 1]);
  }
  return by_level.standard_errors() > kStandardErrors ||
         by_step.standard_errors() > kStandardErrors;
}

}  // namespace

bool is_read_back_noise(std::span<const double> op, std::span<const double> error) {
  const auto step = smallest_neighbour_step(op);
  if (!step || count_moves(op) < kFewestMoves || moves_beyond_noise(op, *step)) return false;
  const auto moves = measure_spread(error);
  if (!moves || moves->constant()) return false;
  for (std::size_t delay = 0; delay <= kLongestDelay; ++delay) {
    if (answers(op, error, delay)) return false;
  }
  return true;
}

}  // namespace loopscope::core::signal
