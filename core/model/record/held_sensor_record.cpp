#include "core/model/record/held_sensor_record.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::core::model {
namespace {

std::size_t renewal_phase(std::span<const double> pv, std::size_t period) {
  std::vector<std::size_t> changes(period, 0);
  for (std::size_t k = 1; k < pv.size(); ++k) {
    if (std::abs(pv[k] - pv[k - 1]) > 0.0) ++changes[k % period];  // NaN compares false
  }
  return static_cast<std::size_t>(std::ranges::max_element(changes) - changes.begin());
}

/// Mean of the recorded values among the `count` samples up to `last`.
double mean_up_to(std::span<const double> values, std::size_t last, std::size_t count) {
  double sum = 0.0;
  std::size_t known = 0;
  for (std::size_t k = last + 1 < count ? 0 : last + 1 - count; k <= last; ++k) {
    if (std::isnan(values[k])) continue;
    sum += values[k];
    ++known;
  }
  return known == 0 ? std::nan("") : sum / static_cast<double>(known);
}

}  // namespace

RenewedRecord renewed_record(std::span<const double> pv, std::span<const double> op,
                             std::span<const double> sp, std::span<const double> error,
                             std::size_t hold_samples) {
  RenewedRecord result;
  result.grid = {hold_samples, renewal_phase(pv, hold_samples)};
  for (std::size_t k = result.grid.first_sample; k < pv.size(); k += hold_samples) {
    result.pv.push_back(pv[k]);
    if (!op.empty()) result.op.push_back(mean_up_to(op, k, hold_samples));
    if (!sp.empty()) result.sp.push_back(sp[k]);
    if (!error.empty()) result.error.push_back(error[k]);
  }
  return result;
}

}  // namespace loopscope::core::model
