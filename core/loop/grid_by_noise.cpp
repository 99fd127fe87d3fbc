#include "core/loop/grid_by_noise.hpp"

#include <cmath>
#include <cstddef>

#include "core/loop/ar_model.hpp"
#include "core/loop/if_finite.hpp"
#include "core/signal/spread.hpp"

namespace loopscope::core::loop {
namespace {

/// As the model that the Harris index is read from (performance.hpp).
constexpr std::size_t kOrder = 20;

}  // namespace

std::optional<double> grid_by_noise(std::span<const double> signal) {
  const std::optional<signal::Spread> spread = signal::measure_spread(signal);
  const std::optional<double> grid = signal::smallest_step(signal);
  const std::optional<ArModel> model = fit_ar(signal, kOrder);
  if (!spread || !grid || !model) return std::nullopt;
  return if_finite(*grid / (spread->std * std::sqrt(model->innovation_share)));
}

}  // namespace loopscope::core::loop
