#pragma once

#include <optional>
#include <vector>

#include "tests/plants/process/random.hpp"
#include "tests/plants/process/simulate.hpp"

namespace loopscope::tests::process {

/// How a historian keeps this plant, drawn so that an oscillation of this period has 6 to 120
/// samples a period and 15 to 600 periods (0 = no matter); nullopt where none will do.
[[nodiscard]] std::optional<std::vector<Window>> draw_windows(const PlantPlan& plan,
                                                              double period_s, Random& random);

/// In a few plants: stretches that were not recorded, of all loops or of one.
void draw_gaps(std::vector<ProcessLoop>& loops, Random& random);

}  // namespace loopscope::tests::process
