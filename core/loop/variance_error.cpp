#include "core/loop/variance_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/loop/correlation.hpp"
#include "core/loop/if_finite.hpp"
#include "core/loop/real_transform.hpp"
#include "core/signal/order/spread.hpp"

namespace loopscope::core::loop {
namespace {

/// The sum over the lags ends at so many times itself (Sokal: 4 to 10): longer adds noise, shorter
/// leaves out what is correlated.
constexpr double kWindow = 5.0;
/// Lags beyond a quarter of the record have too few independent pairs.
constexpr std::size_t kLagShare = 4;
/// No more independent values than samples.
constexpr double kLeastTime = 0.5;

std::vector<double> squared_deviations(std::span<const double> error, double mean) {
  std::vector<double> squares(error.begin(), error.end());
  for (double& value : squares) value = (value - mean) * (value - mean);
  return squares;
}

/// tau of the series with the autocorrelation `rho` from lag 0 on, in samples.
double integrated_time(std::span<const double> rho) {
  double time = 0.5;
  for (std::size_t lag = 1; lag < rho.size(); ++lag) {
    time += rho[lag];
    if (static_cast<double>(lag) >= kWindow * time) break;
  }
  return std::max(time, kLeastTime);
}

}  // namespace

std::optional<double> log_variance_error(std::span<const double> error) {
  const auto spread = signal::measure_spread(error);
  if (!spread || spread->constant()) return std::nullopt;
  const std::vector<double> squares = squared_deviations(error, spread->mean);
  const auto of_squares = signal::measure_spread(squares);
  if (!of_squares || of_squares->constant()) return 0.0;  // a square wave: nothing scatters
  const auto recorded = static_cast<double>(
      std::ranges::count_if(squares, [](double value) { return std::isfinite(value); }));
  const std::size_t most_lag = error.size() / kLagShare;
  RealTransform transform(fast_length(error.size() + most_lag));
  const std::vector<double> rho = autocorrelate(squares, most_lag, transform);
  if (rho.empty()) return std::nullopt;
  const double relative = of_squares->std / of_squares->mean;
  return if_finite(relative * std::sqrt(2.0 * integrated_time(rho) / recorded));
}

}  // namespace loopscope::core::loop
