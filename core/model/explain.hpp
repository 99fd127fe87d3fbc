#pragma once

#include "core/model/explanation.hpp"
#include "core/model/fit.hpp"

namespace loopscope::core::model {

/// Fits the linear loop, then takes in one effect after the other as long as the error on held-out
/// samples falls significantly. `baseline` and `final` are the fits behind the figures.
struct Story {
  Fit baseline;
  Fit final;
  Fit final_mirror;
  std::vector<Step> steps;
};
[[nodiscard]] Story tell(const LoopData& data);

}  // namespace loopscope::core::model
