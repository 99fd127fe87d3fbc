#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/diagnosis/evidence/evidence.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"

namespace loopscope::core::diagnosis {

/// The entry of a verdict's reasons that ends the plain sentences, where there are any.
inline constexpr std::string_view kFiguresFollow = "Figures:";

/// The evidence as one would tell it on the plant, in three sentences at most: what the loop does
/// that the verdict names, how much larger the error is than the least that process and noise
/// allow, and whether the loop oscillates. No statistics: they follow in the other reasons. Empty
/// where nothing was measured.
[[nodiscard]] std::vector<std::string> plain_evidence(VerdictCode code, const Evidence& evidence);

}  // namespace loopscope::core::diagnosis
