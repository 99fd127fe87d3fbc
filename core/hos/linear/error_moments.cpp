#include "core/hos/linear/error_moments.hpp"

#include <cmath>
#include <iterator>

namespace loopscope::core::hos {
namespace {

/// 0 when there is nothing to divide by.
double one_over_mean_square(std::span<const double> errors) {
  double square = 0.0;
  double count = 0.0;
  for (const double error : errors) {
    if (!std::isfinite(error)) continue;
    square += error * error;
    count += 1.0;
  }
  return square > 0.0 ? count / square : 0.0;
}

}  // namespace

void ErrorMoments::Moment::set(Eigen::ArrayXd values) {
  if (!values.isFinite().all()) {
    const auto present = values.isFinite();
    count = static_cast<double>(present.count());
    values = present.select(values, 0.0).eval();
  } else {
    count = static_cast<double>(values.size());
  }
  sum = values.sum();
  squares = values.square().sum();
}

double ErrorMoments::Moment::variance_of_mean() const {
  return (squares / count - mean() * mean()) / count;
}

ErrorMoments::ErrorMoments(std::span<const double> errors) {
  const double scale = one_over_mean_square(errors);
  const Eigen::Map<const Eigen::ArrayXd> e(errors.data(), std::ssize(errors));
  moments_[0].set(std::sqrt(scale) * e);
  for (Eigen::Index lag = 1; lag <= static_cast<Eigen::Index>(kLags) && lag < e.size(); ++lag) {
    const Eigen::Index pairs = e.size() - lag;
    moments_[static_cast<std::size_t>(lag)].set(scale * e.tail(pairs) * e.head(pairs));
  }
}

ErrorMoments& ErrorMoments::operator+=(const ErrorMoments& other) {
  for (std::size_t i = 0; i < kCount; ++i) {
    moments_[i].sum += other.moments_[i].sum;
    moments_[i].squares += other.moments_[i].squares;
    moments_[i].count += other.moments_[i].count;
  }
  return *this;
}

ErrorMoments::Difference ErrorMoments::difference_from(const ErrorMoments& other) const {
  Difference result;
  for (std::size_t i = 0; i < kCount; ++i) {
    const Moment& a = moments_[i];
    const Moment& b = other.moments_[i];
    if (!(a.count > 0.0 && b.count > 0.0)) continue;
    const double difference = a.mean() - b.mean();
    const double variance = a.variance_of_mean() + b.variance_of_mean();
    if (!(variance > 0.0)) continue;
    result.chi_squared += difference * difference / variance;
    result.size += difference * difference;
  }
  return result;
}

}  // namespace loopscope::core::hos
