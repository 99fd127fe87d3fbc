#pragma once

#include <vector>

namespace loopscope::core::simulate {

/// What happens to records beside nonlinearity. Places are shares of the record, 0 to 1.

/// `signal` multiplied by `factor` between two places, from <= to.
[[nodiscard]] std::vector<double> with_level(std::vector<double> signal, double from, double to,
                                             double factor);

/// `signal` with `size`, in its unit, added from a place on.
[[nodiscard]] std::vector<double> with_step(std::vector<double> signal, double from, double size);

/// The sum of all samples up to each.
[[nodiscard]] std::vector<double> running_sum(std::vector<double> signal);

}  // namespace loopscope::core::simulate
