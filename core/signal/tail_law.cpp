#include "core/signal/tail_law.hpp"

#include <algorithm>
#include <cmath>

#include "core/signal/order/order_statistic.hpp"

namespace loopscope::core::signal {
namespace {

constexpr double kInner = 0.2;
/// Twice the share of outliers that is looked for, and more.
constexpr double kOuter = 0.05;

/// The value that a share of `values` exceeds.
double exceeded_by(double share, std::span<const double> values) {
  const auto rank = static_cast<std::size_t>((1.0 - share) * static_cast<double>(values.size()));
  return order_statistic(values, std::min(rank, values.size() - 1));
}

}  // namespace

std::optional<TailLaw> TailLaw::of(std::span<const double> sizes) {
  if (sizes.empty()) return std::nullopt;
  TailLaw law;
  law.count_ = static_cast<double>(sizes.size());
  const double inner = exceeded_by(kInner, sizes);
  law.outer_ = exceeded_by(kOuter, sizes);
  if (!(inner > 0.0) || !(law.outer_ > inner)) return std::nullopt;
  law.shape_ = std::log(std::log(kOuter) / std::log(kInner)) / std::log(law.outer_ / inner);
  return law;
}

double TailLaw::expected_beyond(double size) const {
  return count_ * std::exp(std::log(kOuter) * std::pow(size / outer_, shape_));
}

}  // namespace loopscope::core::signal
