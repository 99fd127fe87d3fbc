#pragma once

#include <vector>

#include "core/model/fit/fit.hpp"

namespace loopscope::core::model {

/// The delays, poles and orders that a search may choose from.
struct ProcessSearch {
  std::size_t longest_delay = 25;  ///< samples
  int starts = 2;                  ///< how many of the best (delay, pole) pairs are polished
};

/// The best-fitting structure with the effects of `start`: delay, poles, integrator and order of
/// process and noise searched again, from the noise model of `start`. By the error on the fit rows;
/// a further order has to earn its parameters by BIC.
[[nodiscard]] Fit search_process(const LoopData& data, const Structure& start,
                                 const ProcessSearch& search = {});

/// `fit` polished at its own delay and the neighbouring ones.
[[nodiscard]] Fit settle(const LoopData& data, const Fit& fit);

/// The best shape on a coarse net of delays and poles, one tap, the noise as it is: a first look at
/// whether an effect that bends op is worth a fit.
[[nodiscard]] ProcessShape glance(const LoopData& data, const Structure& structure);

}  // namespace loopscope::core::model
