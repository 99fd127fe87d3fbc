#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "core/hos/analyse.hpp"
#include "core/hos/slow_look.hpp"
#include "core/loop/oscillation.hpp"
#include "core/loop/performance.hpp"
#include "core/loop/shape.hpp"
#include "core/loop/valve_gain.hpp"
#include "core/model/explanation.hpp"
#include "core/signal/data_quality.hpp"

namespace loopscope::core {

/// What the p-values of the higher-order statistics rest on; the published indices are always those
/// of sp - pv.
enum class TestedOn {
  error,           ///< sp - pv
  model_residual,  ///< sp - pv less the loop's linear answer to a setpoint that moves all the time
};
[[nodiscard]] std::string_view name(TestedOn tested_on);

/// Everything measured on one window; what could not be measured is nullopt in its own struct.
struct Evidence {
  signal::DataQuality data_quality;
  std::optional<hos::Result> hos;  ///< nullopt when the data are not usable
  TestedOn tested_on = TestedOn::error;
  std::size_t samples_wanted = 0;  ///< with which Coupling::too_short would not be; 0 = it is not
  loop::Oscillation oscillation;   ///< of the error
  loop::Performance performance;
  loop::Shape shape;
  loop::ValveGain valve_gain;
  bool integrating = false;  ///< level loop: the vessel integrates (from the catalogue)
  /// The same statistics on data resampled to fit a slow oscillation; nullopt when none is needed
  /// or too little is recorded.
  std::optional<hos::SlowLook> hos_slow;
  /// Samples up to the window's end that the slow look wants; 0 = the window is long enough, or no
  /// slow look is needed.
  std::size_t slow_span_samples = 0;
  /// The fitted loop model's story; nullopt = switched off, no op, or data not usable.
  std::optional<model::Explanation> model;
};

}  // namespace loopscope::core
