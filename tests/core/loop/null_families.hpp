#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "tests/core/loop/signals.hpp"

/// Records in which nothing oscillates, and records in which something does.
namespace loopscope::core::loop::signals {

struct Family {
  std::string_view name;
  std::function<Series(std::size_t samples, std::uint64_t seed)> draw;
};

/// Smooth spectra: noise, drift, well tuned loops, records with gaps.
[[nodiscard]] std::span<const Family> quiet_families();
/// Sinusoids at 0 dB, limit cycles, loops at the edge of stability.
[[nodiscard]] std::span<const Family> oscillating_families();
/// Damped resonances of period 20, which are neither.
[[nodiscard]] std::span<const Family> damped_families();

/// Control error of a scenario of core/simulate.
[[nodiscard]] Series scenario_error(std::string_view scenario, std::size_t samples,
                                    std::uint64_t seed);

}  // namespace loopscope::core::loop::signals
