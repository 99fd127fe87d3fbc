#include "core/loop/harris.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/loop/ar_model.hpp"
#include "core/loop/harris_p.hpp"

namespace loopscope::core::loop {

std::optional<HarrisRange> measure_harris(std::span<const double> error, std::size_t min_delay,
                                          std::size_t max_delay, std::size_t ar_order) {
  const std::optional<ArModel> model = fit_ar(error, ar_order);
  if (!model) return std::nullopt;
  const std::vector<double> psi = impulse_response(*model, max_delay);
  const auto index = [&](std::size_t delay) {
    const auto last = psi.begin() + static_cast<std::ptrdiff_t>(delay);
    const double gain = std::inner_product(psi.begin(), last, psi.begin(), 0.0);
    return std::clamp(model->innovation_share * gain, 0.0, 1.0);
  };
  HarrisRange range{index(min_delay), index(max_delay)};
  if (!std::isfinite(range.low) || !std::isfinite(range.high)) return std::nullopt;
  const auto recorded = static_cast<double>(
      std::count_if(error.begin(), error.end(), [](double v) { return std::isfinite(v); }));
  range.p = harris_p(std::sqrt(range.low * range.high), *model, max_delay, recorded);
  return range;
}

}  // namespace loopscope::core::loop
