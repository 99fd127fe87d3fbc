#pragma once

#include <span>
#include <vector>

#include "core/model/fit/fit.hpp"

namespace loopscope::core::model {

/// A process to start a search from, one tap, and what it leaves on the fit rows.
struct ProcessStart {
  ProcessShape shape;
  double error = 0.0;  ///< sum of squares of pv less its share, both whitened
  double total = 0.0;  ///< the same without op
};

/// Every shape at every delay from 1 to the longest, the noise as it is: dead time is a shift of
/// the whitened answer by rows, so that a shape is whitened once for all its delays (once for each
/// sample of a row where pv is renewed less often). Shapes have none of their own. In the order of
/// shapes.
[[nodiscard]] std::vector<ProcessStart> process_starts(const LoopData& data,
                                                       const Structure& structure,
                                                       std::size_t longest_delay,
                                                       std::span<const ProcessShape> shapes);

}  // namespace loopscope::core::model
