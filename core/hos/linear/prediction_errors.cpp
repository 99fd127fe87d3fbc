#include "core/hos/linear/prediction_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace loopscope::core::hos {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace

/// One prediction error: the sum over i of weight[|i - origin|] times sample i, for i from `first`
/// to `last`.
struct PredictionErrors::Row {
  std::size_t origin;
  std::size_t first;
  std::size_t last;

  [[nodiscard]] std::size_t distance(std::size_t i) const {
    return i > origin ? i - origin : origin - i;
  }
};

PredictionErrors::PredictionErrors(std::span<const double> record,
                                   std::span<const double> coefficients, double mean)
    : weights_{1.0}, forward_(record.size(), kNone), backward_(record.size(), kNone) {
  for (const double a : coefficients) weights_.push_back(-a);
  for (std::size_t lag = 0; lag <= order(); ++lag) {
    products_.push_back(std::inner_product(weights_.begin() + static_cast<std::ptrdiff_t>(lag),
                                           weights_.end(), weights_.begin(), 0.0));
  }
  std::size_t start = 0;
  for (std::size_t t = 0; t < record.size(); ++t) {
    if (!std::isfinite(record[t])) start = t + 1;
    if (t < start + order()) continue;
    double ahead = 0.0;
    double behind = 0.0;
    for (std::size_t j = 0; j <= order(); ++j) {
      ahead += weights_[j] * (record[t - j] - mean);
      behind += weights_[j] * (record[t - order() + j] - mean);
    }
    forward_[t] = ahead;
    if (t - order() < start + order()) backward_[t - order()] = behind;
  }
}

double PredictionErrors::variance() const {
  double sum = 0.0;
  double count = 0.0;
  for (const double error : forward_) {
    if (!std::isfinite(error)) continue;
    sum += error * error;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

/// Calls visit(row, error) for every error that one of the samples first to first + count - 1
/// enters; the row is cut to these samples.
template <typename Visit>
void PredictionErrors::visit_rows(std::size_t first, std::size_t count, Visit visit) const {
  const std::size_t last = first + count - 1;
  for (std::size_t t = first; t <= std::min(last + order(), forward_.size() - 1); ++t) {
    const std::size_t reach = t > order() ? t - order() : 0;
    if (std::isfinite(forward_[t])) {
      visit(Row{t, std::max(first, reach), std::min(last, t)}, forward_[t]);
    }
  }
  for (std::size_t t = first > order() ? first - order() : 0; t <= last; ++t) {
    if (std::isfinite(backward_[t])) {
      visit(Row{t, std::max(first, t), std::min(last, t + order())}, backward_[t]);
    }
  }
}

bool PredictionErrors::is_inside(std::size_t first, std::size_t count) const {
  const std::size_t end = first + count + order();
  if (end > forward_.size()) return false;
  const auto finite = [](double error) { return std::isfinite(error); };
  const auto at = [](const std::vector<double>& errors, std::size_t k) {
    return errors.begin() + static_cast<std::ptrdiff_t>(k);
  };
  const std::size_t before = first > order() ? first - order() : 0;
  return std::all_of(at(forward_, first), at(forward_, end), finite) &&
         std::none_of(at(backward_, before), at(backward_, first + count), finite);
}

/// Every sample enters order + 1 errors: the second derivatives depend on the lag alone.
void PredictionErrors::expand_inside(std::size_t first, Eigen::VectorXd& gradient,
                                     Eigen::MatrixXd& curvature) const {
  const auto terms = static_cast<Eigen::Index>(weights_.size());
  const Eigen::Map<const Eigen::VectorXd> weights(weights_.data(), terms);
  for (Eigen::Index i = 0; i < gradient.size(); ++i) {
    const double* const errors = &forward_[first + static_cast<std::size_t>(i)];
    gradient[i] = weights.dot(Eigen::Map<const Eigen::VectorXd>(errors, terms));
    for (Eigen::Index j = 0; j <= i; ++j) {
      curvature(i, j) = i - j < terms ? products_[static_cast<std::size_t>(i - j)] : 0.0;
    }
  }
}

void PredictionErrors::expand(std::size_t first, Eigen::VectorXd& gradient,
                              Eigen::MatrixXd& curvature) const {
  if (is_inside(first, static_cast<std::size_t>(gradient.size()))) {
    return expand_inside(first, gradient, curvature);
  }
  gradient.setZero();
  curvature.setZero();
  const auto place = [first](std::size_t i) { return static_cast<Eigen::Index>(i - first); };
  visit_rows(first, static_cast<std::size_t>(gradient.size()), [&](const Row& row, double error) {
    for (std::size_t i = row.first; i <= row.last; ++i) {
      const double weight = weights_[row.distance(i)];
      gradient[place(i)] += weight * error;
      for (std::size_t j = row.first; j <= i; ++j) {
        curvature(place(i), place(j)) += weight * weights_[row.distance(j)];
      }
    }
  });
}

void PredictionErrors::change(std::size_t first, const Eigen::VectorXd& change) {
  const auto count = static_cast<std::size_t>(change.size());
  visit_rows(first, count, [&](const Row& row, const double& error) {
    const bool ahead = &error == &forward_[row.origin];
    double& changed = ahead ? forward_[row.origin] : backward_[row.origin];
    for (std::size_t i = row.first; i <= row.last; ++i) {
      changed += weights_[row.distance(i)] * change[static_cast<Eigen::Index>(i - first)];
    }
  });
}

}  // namespace loopscope::core::hos
