#include "core/hos/linear_model.hpp"

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

/// Forward and backward prediction errors of one piece without gaps: of sample number n at
/// forward[n] and at backward[n - order], so that neither has to move.
struct Piece {
  std::vector<double> forward;
  std::vector<double> backward;

  /// Samples whose prediction errors exist at the next order.
  [[nodiscard]] std::size_t length(std::size_t order) const {
    return forward.size() > order + 1 ? forward.size() - order - 1 : 0;
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
double reflection(const std::vector<Piece>& pieces, std::size_t order, const Kernels& kernels) {
  PairSums total;
  for (const Piece& piece : pieces) {
    const std::size_t length = piece.length(order);
    if (length == 0) continue;
    const PairSums sums =
        kernels.sum_pairs(piece.forward.data() + order + 1, piece.backward.data(), length);
    total.product += sums.product;
    total.power += sums.power;
  }
  return total.power > 0.0 ? 2.0 * total.product / total.power : 0.0;
}

/// Replaces the errors by those of the next order.
void advance(std::vector<Piece>& pieces, std::size_t order, double k, const Kernels& kernels) {
  for (Piece& piece : pieces) {
    const std::size_t length = piece.length(order);
    if (length == 0) continue;
    kernels.predict_each_other(piece.forward.data() + order + 1, piece.backward.data(), length, k);
  }
}

/// Levinson's step: coefficients of one order more.
std::vector<double> extend(const std::vector<double>& a, double k) {
  std::vector<double> longer(a.size() + 1);
  for (std::size_t i = 0; i < a.size(); ++i) longer[i] = a[i] - k * a[a.size() - 1 - i];
  longer.back() = k;
  return longer;
}

std::vector<double> burg(Pieces& pieces, const Kernels& kernels) {
  const auto count = static_cast<double>(pieces.samples);
  std::vector<double> current;
  std::vector<double> best;
  double share = 1.0;
  double best_criterion = 0.0;
  for (std::size_t order = 0; order < kLargestOrder; ++order) {
    const double k = reflection(pieces.all, order, kernels);
    advance(pieces.all, order, k, kernels);
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

/// Prediction of *now by the coefficients `a`. The sample before is added last, so that one
/// prediction waits for little of the one before it.
double predict(const std::vector<double>& a, const double* now) {
  double even = 0.0;
  double odd = 0.0;
  std::size_t i = a.size();
  for (; i >= 2; i -= 2) {
    odd += a[i - 1] * *(now - i);
    even += a[i - 2] * *(now - (i - 1));
  }
  if (i == 1) even += a[0] * *(now - 1);
  return odd + even;
}

/// Of the samples that follow as many others as there are coefficients without a gap.
std::vector<double> residuals_of(std::span<const double> signal, double mean,
                                 const std::vector<double>& a, const Kernels& kernels) {
  if (signal.size() <= a.size()) return {};
  std::vector<double> centred(signal.begin(), signal.end());
  for (double& value : centred) value -= mean;
  std::vector<double> residuals(centred.size() - a.size());
  kernels.subtract_predictions(centred.data() + a.size(), residuals.size(), a, residuals.data());
  std::size_t kept = 0;
  std::size_t after_gap = 0;
  for (std::size_t t = 0; t < centred.size(); ++t) {
    if (!std::isfinite(centred[t])) after_gap = t + 1;
    if (t >= after_gap + a.size()) residuals[kept++] = residuals[t - a.size()];
  }
  residuals.resize(kept);
  return residuals;
}

}  // namespace

std::optional<LinearModel> LinearModel::fit(std::span<const double> signal,
                                            const Kernels& kernels) {
  Pieces pieces = split(signal);
  const double rounding =
      kRoundingUnits * std::numeric_limits<double>::epsilon() * largest_magnitude(signal);
  if (!(pieces.variance > rounding * rounding)) return std::nullopt;
  const double mean = pieces.mean;
  std::vector<double> coefficients = burg(pieces, kernels);
  std::vector<double> residuals = residuals_of(signal, mean, coefficients, kernels);
  if (residuals.size() < kFewestResiduals) return std::nullopt;
  return LinearModel(std::move(coefficients), ResidualNoise(std::move(residuals)));
}

std::vector<double> LinearModel::draw(std::span<const double> like, std::mt19937_64& random) const {
  std::vector<double> record;
  draw(like, random, record);
  return record;
}

void LinearModel::draw(std::span<const double> like, std::mt19937_64& random,
                       std::vector<double>& record) const {
  const std::size_t order = coefficients_.size();
  const std::size_t before = order + kSettling;
  record.resize(before + like.size());
  std::fill_n(record.begin(), order, 0.0);
  for (std::size_t t = order; t < record.size(); ++t) {
    record[t] = predict(coefficients_, &record[t]) + noise_.draw(random);
  }
  std::copy(record.begin() + static_cast<std::ptrdiff_t>(before), record.end(), record.begin());
  record.resize(like.size());
  for (std::size_t t = 0; t < record.size(); ++t) {
    if (!std::isfinite(like[t])) record[t] = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace loopscope::core::hos
