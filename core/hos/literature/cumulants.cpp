#include "core/hos/literature/cumulants.hpp"

#include <cmath>
#include <vector>

namespace loopscope::core::hos {
namespace {

/// Samples about their mean and who is present: a missing one has zero in both.
struct Centred {
  std::vector<double> value;
  std::vector<double> present;
  double count = 0.0;
};

Centred centred(std::span<const double> signal) {
  Centred result{std::vector<double>(signal.size()), std::vector<double>(signal.size()), 0.0};
  double sum = 0.0;
  double first = 0.0;  // summed about it: a large offset must not eat the digits of the mean
  for (std::size_t n = 0; n < signal.size(); ++n) {
    if (std::isfinite(signal[n])) {
      first = result.count > 0.0 ? first : signal[n];
      result.present[n] = 1.0;
      result.count += 1.0;
      sum += signal[n] - first;
    }
  }
  for (std::size_t n = 0; n < signal.size(); ++n) {
    result.value[n] = result.present[n] > 0.0 ? signal[n] - first - sum / result.count : 0.0;
  }
  return result;
}

/// Mean of x(k) x(k + t1) x(k + t2), 0 <= t2 <= t1.
double mean_product(const Centred& x, std::size_t t1, std::size_t t2) {
  double sum = 0.0;
  double triples = 0.0;
  for (std::size_t k = 0; k + t1 < x.value.size(); ++k) {
    sum += x.value[k] * x.value[k + t1] * x.value[k + t2];
    triples += x.present[k] * x.present[k + t1] * x.present[k + t2];
  }
  return triples > 0.0 ? sum / triples : 0.0;
}

/// Writes one value to the six places that stationarity makes equal.
void fill_symmetric(Eigen::MatrixXd& cumulant, Eigen::Index zero, Eigen::Index t1, Eigen::Index t2,
                    double value) {
  const auto both = [&](Eigen::Index a, Eigen::Index b) {
    cumulant(zero + a, zero + b) = value;
    cumulant(zero + b, zero + a) = value;
  };
  both(t1, t2);
  both(-t2, t1 - t2);
  both(t2 - t1, -t1);
}

}  // namespace

Eigen::MatrixXd third_order_cumulant(std::span<const double> signal, std::size_t max_lag) {
  const Centred x = centred(signal);
  if (x.count == 0.0) {
    return {};
  }
  const auto zero = static_cast<Eigen::Index>(max_lag);
  Eigen::MatrixXd cumulant = Eigen::MatrixXd::Zero(2 * zero + 1, 2 * zero + 1);
  for (std::size_t t1 = 0; t1 <= max_lag; ++t1) {
    for (std::size_t t2 = 0; t2 <= t1; ++t2) {
      fill_symmetric(cumulant, zero, static_cast<Eigen::Index>(t1), static_cast<Eigen::Index>(t2),
                     mean_product(x, t1, t2));
    }
  }
  return cumulant;
}

}  // namespace loopscope::core::hos
