#include "core/hos/linear/linear_model.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/hos/numeric/magnitude.hpp"

namespace loopscope::core::hos {
namespace {

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
  const double first = first_finite(signal);
  double sum = 0.0;
  const auto known = [](double value) { return std::isfinite(value); };
  for (auto begin = std::ranges::find_if(signal, known); begin != signal.end();) {
    const auto end = std::find_if_not(begin, signal.end(), known);
    pieces.all.push_back({{begin, end}, {}});
    for (auto value = begin; value != end; ++value) sum += *value - first;
    pieces.samples += static_cast<std::size_t>(end - begin);
    begin = std::find_if(end, signal.end(), known);
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

std::vector<double> burg(Pieces& pieces, const Kernels& kernels, const OrderChoice& choice) {
  const auto count = static_cast<double>(pieces.samples);
  std::vector<double> current;
  std::vector<double> best;
  double share = 1.0;
  double best_criterion = 0.0;
  for (std::size_t order = 0; order < choice.largest; ++order) {
    const double k = reflection(pieces.all, order, kernels);
    advance(pieces.all, order, k, kernels);
    current = extend(current, k);
    share *= 1.0 - k * k;
    const double criterion = count * std::log(std::max(share, std::numeric_limits<double>::min())) +
                             choice.penalty * static_cast<double>(order + 1);
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

/// Whether x(t) = a_1 x(t-1) + ... forgets: all reflection coefficients, taken off from the last to
/// the first, lie below 1.
bool is_stable(std::vector<double> a) {
  while (!a.empty()) {
    const double k = a.back();
    if (!(std::abs(k) < 1.0)) return false;
    a.pop_back();
    const std::vector<double> longer = a;
    for (std::size_t i = 0; i < a.size(); ++i) {
      a[i] = (longer[i] + k * longer[a.size() - 1 - i]) / (1.0 - k * k);
    }
  }
  return true;
}

/// The samples about the mean, 0 where missing: where that matters the error is NaN.
Eigen::VectorXd centred_samples(std::span<const double> signal, double mean) {
  Eigen::VectorXd centred(std::ssize(signal));
  for (std::size_t t = 0; t < signal.size(); ++t) {
    centred[static_cast<Eigen::Index>(t)] = std::isfinite(signal[t]) ? signal[t] - mean : 0.0;
  }
  return centred;
}

}  // namespace

std::optional<LinearModel> LinearModel::fit(std::span<const double> signal, const Kernels& kernels,
                                            const OrderChoice& order) {
  Pieces pieces = split(signal);
  const double rounding =
      kRoundingUnits * std::numeric_limits<double>::epsilon() * largest_magnitude(signal);
  if (!(pieces.variance > rounding * rounding)) return std::nullopt;
  std::vector<double> coefficients = burg(pieces, kernels, order);
  std::size_t residuals = 0;
  for (const Piece& piece : pieces.all) {
    residuals += piece.forward.size() - std::min(piece.forward.size(), coefficients.size());
  }
  if (residuals < kFewestResiduals) return std::nullopt;
  return LinearModel(std::move(coefficients), pieces.mean);
}

std::vector<double> LinearModel::errors(std::span<const double> signal,
                                        const Kernels& kernels) const {
  const std::size_t order = coefficients_.size();
  std::vector<double> result(signal.size(), std::numeric_limits<double>::quiet_NaN());
  if (signal.size() <= order) return result;
  std::vector<double> centred(signal.begin(), signal.end());
  for (double& value : centred) value -= mean_;
  kernels.subtract_predictions(centred.data() + order, signal.size() - order, coefficients_,
                               result.data() + order);
  std::size_t known_from = order;
  for (std::size_t t = 0; t < signal.size(); ++t) {
    if (!std::isfinite(signal[t])) known_from = t + 1 + order;
    if (t < known_from) result[t] = std::numeric_limits<double>::quiet_NaN();
  }
  return result;
}

LinearModel LinearModel::reweighted(std::span<const double> signal, std::span<const double> errors,
                                    std::span<const double> scale, const Kernels& kernels) const {
  const Eigen::Index order = std::ssize(coefficients_);
  if (order == 0) return *this;
  const Eigen::VectorXd x = centred_samples(signal, mean_);
  const Eigen::Index count = x.size() - order;
  Eigen::VectorXd weights(count);
  for (Eigen::Index n = 0; n < count; ++n) {
    const auto t = static_cast<std::size_t>(n + order);
    weights[n] = std::isfinite(errors[t]) ? 1.0 / (scale[t] * scale[t]) : 0.0;
  }
  Eigen::MatrixXd products(order, order);
  Eigen::VectorXd target(order);
  Eigen::VectorXd sums(order + 1);  // of a lag's samples with those of lag 0, 1, ...
  for (Eigen::Index i = 0; i < order; ++i) {
    const Eigen::VectorXd lagged = weights.cwiseProduct(x.segment(order - 1 - i, count));
    kernels.sum_lags({lagged.data(), lagged.data() + count}, x.data() + order,
                     {sums.data(), sums.data() + i + 2});
    target[i] = sums[0];
    products.row(i).head(i + 1) = sums.segment(1, i + 1).transpose();
  }
  products = products.selfadjointView<Eigen::Lower>();
  const Eigen::VectorXd found = products.ldlt().solve(target);
  std::vector<double> coefficients(found.begin(), found.end());
  if (!found.allFinite() || !is_stable(coefficients)) return *this;
  return {std::move(coefficients), mean_};
}

void LinearModel::drive(std::span<double> record) const {
  for (std::size_t t = coefficients_.size(); t < record.size(); ++t) {
    record[t] += predict(coefficients_, &record[t]);
  }
}

}  // namespace loopscope::core::hos
