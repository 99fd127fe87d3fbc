#include "core/model/controller/sampled_process.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace loopscope::core::model {
namespace {

/// Time constants closer than this share are moved apart: the exact formula divides by their
/// difference.
constexpr double kLeastSeparation = 1e-4;

double pole_of(double time_s, double interval_s) {
  return time_s > 0.0 ? std::exp(-interval_s / time_s) : 0.0;
}

/// Step response of two lags in series after one interval, for a gain of 1.
double two_lags_step(double slow_s, double fast_s, double interval_s) {
  if (fast_s <= 0.0) return 1.0 - pole_of(slow_s, interval_s);
  fast_s = std::min(fast_s, slow_s * (1.0 - kLeastSeparation));
  return 1.0 + (fast_s * pole_of(fast_s, interval_s) - slow_s * pole_of(slow_s, interval_s)) /
                   (slow_s - fast_s);
}

void check(const ProcessFit& fit, double interval_s) {
  const double sum = fit.gain + fit.time_constant_s + fit.second_time_constant_s + fit.delay_s;
  if (!(interval_s > 0.0) || !std::isfinite(sum)) {
    throw std::invalid_argument("sampled process: interval or process out of range");
  }
}

SampledProcess integrating(const ProcessFit& fit, double interval_s) {
  const double pole = pole_of(fit.time_constant_s, interval_s);
  const double whole = fit.gain * interval_s * (1.0 - pole);
  const double first = fit.gain * (interval_s - fit.time_constant_s * (1.0 - pole));
  return {{first, whole - first}, product({1.0, -1.0}, {1.0, -pole}), 1};
}

SampledProcess settling(const ProcessFit& fit, double interval_s) {
  const auto [fast_s, slow_s] = std::minmax(fit.time_constant_s, fit.second_time_constant_s);
  const double fast = pole_of(fast_s, interval_s);
  const double slow = pole_of(slow_s, interval_s);
  const double whole = fit.gain * (1.0 - slow) * (1.0 - fast);
  const double first = fit.gain * two_lags_step(slow_s, fast_s, interval_s);
  return {{first, whole - first}, product({1.0, -slow}, {1.0, -fast}), 1};
}

}  // namespace

Polynomial product(const Polynomial& left, const Polynomial& right) {
  Polynomial result(left.size() + right.size() - 1, 0.0);
  for (std::size_t i = 0; i < left.size(); ++i) {
    for (std::size_t j = 0; j < right.size(); ++j) result[i + j] += left[i] * right[j];
  }
  return result;
}

Polynomial sum(const Polynomial& left, const Polynomial& right) {
  Polynomial result(std::max(left.size(), right.size()), 0.0);
  for (std::size_t i = 0; i < left.size(); ++i) result[i] += left[i];
  for (std::size_t i = 0; i < right.size(); ++i) result[i] += right[i];
  return result;
}

std::complex<double> value(const Polynomial& polynomial, std::complex<double> inverse_z) {
  return std::accumulate(
      polynomial.rbegin(), polynomial.rend(), std::complex<double>(0.0),
      [&](const std::complex<double>& sum, double c) { return sum * inverse_z + c; });
}

SampledProcess sample_process(const ProcessFit& fit, double interval_s) {
  check(fit, interval_s);
  SampledProcess process =
      fit.integrating ? integrating(fit, interval_s) : settling(fit, interval_s);
  process.delay_samples =
      static_cast<std::size_t>(std::max(0.0, std::round(fit.delay_s / interval_s)));
  return process;
}

std::complex<double> response(const SampledProcess& process, double w) {
  const std::complex<double> inverse_z = std::polar(1.0, -w);
  const std::complex<double> delay =
      std::polar(1.0, -w * static_cast<double>(process.delay_samples));
  return delay * value(process.numerator, inverse_z) / value(process.denominator, inverse_z);
}

}  // namespace loopscope::core::model
