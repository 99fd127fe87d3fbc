#include "core/loop/correlation.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "core/signal/order/spread.hpp"

namespace loopscope::core::loop {
namespace {

/// A lag with fewer pairs than this share of the samples says more about its few pairs than about
/// the signal.
constexpr double kLeastPairs = 0.125;

struct Standardised {
  std::vector<double> values;  // 0 where missing
  std::vector<double> mask;    // 1 where recorded
  double recorded = 0.0;
};

Standardised standardise(std::span<const double> x, const signal::Spread& spread) {
  Standardised result{std::vector<double>(x.size(), 0.0), std::vector<double>(x.size(), 0.0), 0.0};
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!std::isfinite(x[k])) continue;
    result.values[k] = (x[k] - spread.mean) / spread.std;
    result.mask[k] = 1.0;
    result.recorded += 1.0;
  }
  return result;
}

/// sum_k x(k) y(k + l).
std::vector<double> lagged_products(const std::vector<double>& x, const std::vector<double>& y,
                                    RealTransform& transform) {
  RealTransform::Spectrum product = transform.forward(x);
  if (&x == &y) {
    for (std::complex<double>& value : product) value = std::norm(value);
  } else {
    const RealTransform::Spectrum other = transform.forward(y);
    for (std::size_t i = 0; i < product.size(); ++i) product[i] = std::conj(product[i]) * other[i];
  }
  return transform.inverse(std::move(product));
}

/// Number of pairs per lag; without gaps it is known and needs no transform.
std::vector<double> count_pairs(const Standardised& x, const Standardised& y,
                                RealTransform& transform) {
  const std::size_t count = x.mask.size();
  const auto all = static_cast<double>(count);
  if (x.recorded < all || y.recorded < all) return lagged_products(x.mask, y.mask, transform);
  std::vector<double> pairs(transform.length(), 0.0);
  const std::size_t last_lag = std::min(count - 1, pairs.size() / 2);
  for (std::size_t lag = 0; lag <= last_lag; ++lag) {
    pairs[lag] = static_cast<double>(count - lag);
    if (lag > 0) pairs[pairs.size() - lag] = pairs[lag];
  }
  return pairs;
}

/// A circular transform leaves negative lags at the end.
std::size_t index_of(std::ptrdiff_t lag, std::size_t length) {
  return lag < 0 ? length - static_cast<std::size_t>(-lag) : static_cast<std::size_t>(lag);
}

/// Mean product per lag, up to the last lag that has `least` pairs on both sides.
Correlation divide(const std::vector<double>& products, const std::vector<double>& pairs,
                   double least, std::size_t max_lag) {
  const auto enough = [&](std::size_t lag) {
    const auto signed_lag = static_cast<std::ptrdiff_t>(lag);
    // Counts out of a transform are whole numbers but for rounding.
    return std::round(std::min(pairs[index_of(signed_lag, pairs.size())],
                               pairs[index_of(-signed_lag, pairs.size())])) > least - 0.5;
  };
  Correlation result;
  if (!enough(0)) return result;
  while (result.max_lag < max_lag && enough(result.max_lag + 1)) ++result.max_lag;
  const auto last = static_cast<std::ptrdiff_t>(result.max_lag);
  for (std::ptrdiff_t lag = -last; lag <= last; ++lag) {
    const std::size_t index = index_of(lag, products.size());
    result.values.push_back(products[index] / std::round(pairs[index]));
  }
  return result;
}

}  // namespace

Correlation correlate(std::span<const double> x, std::span<const double> y, std::size_t max_lag,
                      RealTransform& transform) {
  const auto spread_x = signal::measure_spread(x);
  const auto spread_y = signal::measure_spread(y);
  if (!spread_x || !spread_y || spread_x->constant() || spread_y->constant()) return {};
  const Standardised left = standardise(x, *spread_x);
  const Standardised right = standardise(y, *spread_y);
  const double least = std::max(1.0, kLeastPairs * std::min(left.recorded, right.recorded));
  return divide(lagged_products(left.values, right.values, transform),
                count_pairs(left, right, transform), least, max_lag);
}

std::vector<double> autocorrelate(std::span<const double> x, std::size_t max_lag,
                                  RealTransform& transform) {
  const auto spread = signal::measure_spread(x);
  if (!spread || spread->constant()) return {};
  const Standardised series = standardise(x, *spread);
  const double least = std::max(1.0, kLeastPairs * series.recorded);
  const Correlation both_sides = divide(lagged_products(series.values, series.values, transform),
                                        count_pairs(series, series, transform), least, max_lag);
  return {both_sides.values.begin() + static_cast<std::ptrdiff_t>(both_sides.max_lag),
          both_sides.values.end()};
}

}  // namespace loopscope::core::loop
