#include "core/hos/linear_model.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/hos/magnitude.hpp"

namespace loopscope::core::hos {
namespace {

/// Enough for two resonances and the noise around them.
constexpr std::size_t kLargestOrder = 24;
/// Samples before the record, in which the process forgets that it started at rest.
constexpr std::size_t kSettling = 1000;

using Series = Eigen::Map<Eigen::VectorXd>;
using ConstSeries = Eigen::Map<const Eigen::VectorXd>;

/// Forward and backward prediction errors of one piece without gaps.
struct Piece {
  std::vector<double> forward;
  std::vector<double> backward;

  /// Samples whose prediction errors exist at the next order.
  [[nodiscard]] Eigen::Index length(std::size_t order) const {
    return static_cast<Eigen::Index>(forward.size() > order + 1 ? forward.size() - order - 1 : 0);
  }
};

struct Pieces {
  std::vector<Piece> all;
  double mean = 0.0;
  double variance = 0.0;
  std::size_t samples = 0;
};

Pieces split(std::span<const double> signal) {
  Pieces pieces;
  bool open = false;
  const double first = first_finite(signal);
  double sum = 0.0;
  for (const double value : signal) {
    if (std::isfinite(value)) {
      if (!open) pieces.all.emplace_back();
      pieces.all.back().forward.push_back(value);
      sum += value - first;
      ++pieces.samples;
    }
    open = std::isfinite(value);
  }
  pieces.mean = first + sum / static_cast<double>(std::max<std::size_t>(pieces.samples, 1));
  for (Piece& piece : pieces.all) {
    for (double& value : piece.forward) {
      value -= pieces.mean;
      pieces.variance += value * value;
    }
    piece.backward = piece.forward;
  }
  pieces.variance /= static_cast<double>(std::max<std::size_t>(pieces.samples, 1));
  return pieces;
}

/// Burg's reflection coefficient of the next order (errors of order `order` go in); 0 when nothing
/// is left to predict.
double reflection(const std::vector<Piece>& pieces, std::size_t order) {
  double product = 0.0;
  double power = 0.0;
  for (const Piece& piece : pieces) {
    const ConstSeries forward(piece.forward.data() + order + 1, piece.length(order));
    const ConstSeries backward(piece.backward.data() + order, piece.length(order));
    product += forward.dot(backward);
    power += forward.squaredNorm() + backward.squaredNorm();
  }
  return power > 0.0 ? 2.0 * product / power : 0.0;
}

/// Replaces the errors by those of the next order.
void advance(std::vector<Piece>& pieces, std::size_t order, double k) {
  for (Piece& piece : pieces) {
    Series forward(piece.forward.data() + order + 1, piece.length(order));
    const Eigen::VectorXd backward =
        ConstSeries(piece.backward.data() + order, piece.length(order));
    Series(piece.backward.data() + order + 1, piece.length(order)) = backward - k * forward;
    forward -= k * backward;
  }
}

/// Levinson's step: coefficients of one order more.
std::vector<double> extend(const std::vector<double>& a, double k) {
  std::vector<double> longer(a.size() + 1);
  for (std::size_t i = 0; i < a.size(); ++i) longer[i] = a[i] - k * a[a.size() - 1 - i];
  longer.back() = k;
  return longer;
}

std::vector<double> burg(Pieces& pieces) {
  const auto count = static_cast<double>(pieces.samples);
  std::vector<double> current;
  std::vector<double> best;
  double share = 1.0;
  double best_criterion = 0.0;
  for (std::size_t order = 0; order < kLargestOrder; ++order) {
    const double k = reflection(pieces.all, order);
    advance(pieces.all, order, k);
    current = extend(current, k);
    share *= 1.0 - k * k;
    const double criterion = count * std::log(std::max(share, std::numeric_limits<double>::min())) +
                             2.0 * static_cast<double>(order + 1);
    if (criterion < best_criterion) {
      best_criterion = criterion;
      best = current;
    }
  }
  return best;
}

/// Prediction of *now; `backwards` are the coefficients, the one of the oldest sample first.
double predict(const std::vector<double>& backwards, const double* now) {
  const auto order = static_cast<Eigen::Index>(backwards.size());
  return ConstSeries(backwards.data(), order).dot(ConstSeries(now - order, order));
}

std::vector<double> residuals_of(std::span<const double> signal, double mean,
                                 const std::vector<double>& a) {
  std::vector<double> centred(signal.begin(), signal.end());
  for (double& value : centred) value -= mean;
  const std::vector<double> backwards(a.rbegin(), a.rend());
  std::vector<double> residuals;
  std::size_t after_gap = 0;
  for (std::size_t t = 0; t < centred.size(); ++t) {
    if (!std::isfinite(centred[t])) after_gap = t + 1;
    if (t < after_gap + a.size()) continue;
    residuals.push_back(centred[t] - predict(backwards, &centred[t]));
  }
  return residuals;
}

}  // namespace

std::optional<LinearModel> LinearModel::fit(std::span<const double> signal) {
  Pieces pieces = split(signal);
  const double rounding =
      kRoundingUnits * std::numeric_limits<double>::epsilon() * largest_magnitude(signal);
  if (!(pieces.variance > rounding * rounding)) return std::nullopt;
  const double mean = pieces.mean;
  std::vector<double> coefficients = burg(pieces);
  std::vector<double> residuals = residuals_of(signal, mean, coefficients);
  if (residuals.size() < kFewestResiduals) return std::nullopt;
  return LinearModel(std::move(coefficients), ResidualNoise(std::move(residuals)));
}

std::vector<double> LinearModel::draw(std::span<const double> like, std::mt19937_64& random) const {
  const std::size_t before = coefficients_.size() + kSettling;
  const std::vector<double> backwards(coefficients_.rbegin(), coefficients_.rend());
  std::vector<double> process(before + like.size(), 0.0);
  for (std::size_t t = coefficients_.size(); t < process.size(); ++t) {
    process[t] = predict(backwards, &process[t]) + noise_.draw(random);
  }
  std::vector<double> record(process.begin() + static_cast<std::ptrdiff_t>(before), process.end());
  for (std::size_t t = 0; t < record.size(); ++t) {
    if (!std::isfinite(like[t])) record[t] = std::numeric_limits<double>::quiet_NaN();
  }
  return record;
}

}  // namespace loopscope::core::hos
