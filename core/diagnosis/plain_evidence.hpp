#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/evidence/evidence.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"

namespace loopscope::core::diagnosis {

/// At most so many sentences come before the figures.
inline constexpr std::size_t kPlainSentences = 3;

/// The evidence as one would tell it on the plant: what the loop does that the verdict names, what
/// that costs beside the best controller, and whether the loop oscillates. No statistics: they
/// follow in the other reasons. Empty where nothing was measured.
[[nodiscard]] std::vector<std::string> plain_evidence(VerdictCode code, const Evidence& evidence);

}  // namespace loopscope::core::diagnosis
