#pragma once

#include <cstddef>
#include <optional>

#include "core/diagnosis/analysis_settings.hpp"
#include "core/loop/oscillation.hpp"
#include "core/signal/loop_window.hpp"
#include "core/signal/prepared_loop.hpp"

namespace loopscope::core {

/// A window made ready, and what has to be known of it before more of the history is asked for.
struct FirstLook {
  signal::PreparedLoop loop;
  loop::Oscillation oscillation;      ///< of the error; empty when the data are not usable
  std::size_t slow_span_samples = 0;  ///< as in Evidence

  /// Period of the oscillation in samples; nullopt when none is present.
  [[nodiscard]] std::optional<double> period_samples() const;
};

/// The part of a diagnosis that comes before all other figures. Throws std::invalid_argument for
/// series of different lengths and a sample interval that is not above 0.
[[nodiscard]] FirstLook first_look(const signal::LoopWindow& window,
                                   const AnalysisSettings& settings);

}  // namespace loopscope::core
