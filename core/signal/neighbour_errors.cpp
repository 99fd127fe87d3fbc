#include "core/signal/neighbour_errors.hpp"

#include <cmath>
#include <cstddef>
#include <optional>

#include "core/signal/order/spread.hpp"

namespace loopscope::core::signal {
namespace {

constexpr std::size_t kNeighbours = 2;

/// Keeps the equations of a signal without noise solvable; no weight in any other.
constexpr double kRidge = 1e-9;

/// A sample about the mean, and the sums of its neighbours at distance one and two.
struct Row {
  double middle = 0.0;
  double near = 0.0;
  double far = 0.0;
};

Row row_at(const Samples& samples, std::size_t k, double mean) {
  return {samples[k] - mean, samples[k - 1] + samples[k + 1] - 2.0 * mean,
          samples[k - 2] + samples[k + 2] - 2.0 * mean};
}

bool touches(const std::vector<bool>& suspect, std::size_t k) {
  if (suspect.empty()) return false;
  for (std::size_t i = k - kNeighbours; i <= k + kNeighbours; ++i) {
    if (suspect[i]) return true;
  }
  return false;
}

struct Weights {
  double near = 0.0;
  double far = 0.0;
};

/// The normal equations of the least squares.
class Normal {
 public:
  void add(const Row& row) {
    near_ += row.near * row.near;
    far_ += row.far * row.far;
    both_ += row.near * row.far;
    near_middle_ += row.near * row.middle;
    far_middle_ += row.far * row.middle;
  }
  [[nodiscard]] std::optional<Weights> solve() const {
    const double near = (1.0 + kRidge) * near_;
    const double far = (1.0 + kRidge) * far_;
    const double determinant = near * far - both_ * both_;
    if (!(determinant > 0.0) || !std::isfinite(determinant)) return std::nullopt;
    return Weights{(near_middle_ * far - far_middle_ * both_) / determinant,
                   (far_middle_ * near - near_middle_ * both_) / determinant};
  }

 private:
  double near_ = 0.0;
  double far_ = 0.0;
  double both_ = 0.0;
  double near_middle_ = 0.0;
  double far_middle_ = 0.0;
};

std::optional<Weights> fit(const Samples& samples, const std::vector<bool>& suspect, double mean) {
  Normal normal;
  for (std::size_t k = kNeighbours; k + kNeighbours < samples.size(); ++k) {
    const Row row = row_at(samples, k, mean);
    if (std::isfinite(row.middle + row.near + row.far) && !touches(suspect, k)) normal.add(row);
  }
  return normal.solve();
}

}  // namespace

std::vector<double> neighbour_errors(const Samples& samples, const std::vector<bool>& suspect) {
  std::vector<double> errors(samples.size(), 0.0);
  const std::optional<Spread> spread = measure_spread(samples);
  if (!spread || spread->constant()) return errors;
  const std::optional<Weights> weights = fit(samples, suspect, spread->mean);
  if (!weights) return errors;
  for (std::size_t k = kNeighbours; k + kNeighbours < samples.size(); ++k) {
    const Row row = row_at(samples, k, spread->mean);
    const double error = row.middle - weights->near * row.near - weights->far * row.far;
    if (std::isfinite(error)) errors[k] = error;
  }
  return errors;
}

}  // namespace loopscope::core::signal
