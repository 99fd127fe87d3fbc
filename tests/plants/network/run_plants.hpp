#pragma once

#include <vector>

#include "tests/plants/network/options.hpp"
#include "tests/plants/network/outcome.hpp"

namespace loopscope::tests::network {

/// Every plant of `options`, in order, the same whatever the number of threads but for the
/// milliseconds. Throws what a plant throws.
[[nodiscard]] std::vector<Outcome> run_plants(const Options& options);

}  // namespace loopscope::tests::network
