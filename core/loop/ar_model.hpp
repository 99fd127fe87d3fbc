#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace loopscope::core::loop {

/// x(t) = a_1 x(t-1) + ... + a_p x(t-p) + e(t), x about its mean.
struct ArModel {
  std::vector<double> coefficients;  ///< a_1 .. a_p
  double innovation_share = 0.0;     ///< variance of e over variance of x, >= 0
};

/// Least squares over every t whose own and p previous samples are recorded (`series` may hold
/// NaN). nullopt when the series is constant or fewer than 5 (p + 1) such rows are left.
[[nodiscard]] std::optional<ArModel> fit_ar(std::span<const double> series, std::size_t order);

/// psi_0 .. psi_{count-1} of 1 / (1 - a_1 q^-1 - ...): the model's answer to a unit pulse.
[[nodiscard]] std::vector<double> impulse_response(const ArModel& model, std::size_t count);

}  // namespace loopscope::core::loop
