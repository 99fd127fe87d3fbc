#pragma once

#include <string>

#include "core/model/controller/sampled_process.hpp"
#include "core/model/fit/fit.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::core::model {

/// The process of a fit in pv units, % and seconds.
[[nodiscard]] ProcessFit report_process(const LoopData& data, const Fit& fit);

/// The same with its numerator, as the samples see it.
[[nodiscard]] SampledProcess sampled(const LoopData& data, const Fit& fit);

/// Order, gain, time constants, delay and noise in one line.
[[nodiscard]] std::string describe(const LoopData& data, const Fit& fit);

}  // namespace loopscope::core::model
