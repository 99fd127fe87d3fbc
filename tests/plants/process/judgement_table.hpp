#pragma once

#include <string>
#include <vector>

#include "tests/plants/process/judged_plant.hpp"

namespace loopscope::tests::process {

/// Counts by cause, the share of plants with a source in which it comes first, and the error of the
/// odds.
[[nodiscard]] std::string table_of(const std::vector<Judgement>& judgements);

/// How far the odds of the most likely answer lie from how often it is true: the mean over five
/// equal bins of the odds, weighted by their plants (Naeini et al. 2015). Plants whose event was
/// not found are left out.
[[nodiscard]] double calibration_error(const std::vector<Judgement>& judgements);

}  // namespace loopscope::tests::process
