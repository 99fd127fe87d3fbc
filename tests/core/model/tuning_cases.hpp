#pragma once

#include <array>
#include <cstddef>

#include "core/model/controller/tuning.hpp"

namespace loopscope::core::model::known {

/// How often a group of loops was judged what.
struct TuningCounts {
  std::array<std::size_t, 4> judged{};  ///< by Tuning
  [[nodiscard]] std::size_t total() const;
  [[nodiscard]] double share(Tuning tuning) const;
};

/// By what the true loop is, the judgement having seen a fit off by a fifth. Loops between the
/// groups are not counted.
struct TuningRates {
  TuningCounts fine;       ///< Ms < 2, integral of |error| < 2.5 times SIMC's
  TuningCounts tight;      ///< Ms > 3.5 or just unstable
  TuningCounts sluggish;   ///< Ms < 1.8, more than 5 times; self-regulating
  TuningCounts averaging;  ///< the same, integrating
};

/// First order, second order and integrating in turn, delay 1 to 10, gain 0.05 to 6 times SIMC's,
/// integral time 0.4 to 2.5 times.
[[nodiscard]] TuningRates tuning_rates(std::size_t loops);

}  // namespace loopscope::core::model::known
