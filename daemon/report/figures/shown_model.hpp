#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/model/traces.hpp"

namespace loopscope::daemon {

/// Which series of a stage stands beside the measurement.
struct ShownModel {
  bool simulated = true;  ///< run on op alone; else the prediction one sample ahead

  [[nodiscard]] const std::vector<double>& series_of(const core::model::TraceStage& stage) const;
  /// "run on op alone", "predicting one sample ahead"
  [[nodiscard]] std::string_view words() const;
};

/// The model run on op alone shows what an effect does, but it is not what most effects are scored
/// by: of a vessel, which keeps every error, it may run away while the prediction one sample ahead
/// gets better. It is shown where over these samples no stage is farther from the measurement
/// than the one before, else the prediction that was scored. A stage without a prediction was
/// scored by its simulation, and all are shown by theirs. `from` and `samples` count within
/// `measured`.
[[nodiscard]] ShownModel shown_model(const std::vector<double>& measured,
                                     const std::vector<const core::model::TraceStage*>& stages,
                                     std::size_t from, std::size_t samples);

}  // namespace loopscope::daemon
