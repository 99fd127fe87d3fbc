#pragma once

#include <optional>

#include "core/model/residual_tests/statistics/residual_context.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"

namespace loopscope::core::model {

/// "op_level": does the residual say that op's moves work more at one level than at another? Beyond
/// op itself (score_test.hpp), at lags of 1 to 12 samples: the square of op about its mean (a
/// curved valve characteristic), and how far op is above or below a limit, at its 65th and 92nd
/// percentile and their mirror images (a valve that stops short). The parts are combined
/// (hos/combine_p.hpp). Nominates valve_characteristic, and valve_saturation with the limit that
/// fits best, to about the spacing of the percentiles. nullopt when op is missing or constant.
[[nodiscard]] std::optional<TestOutcome> test_op_level(const ResidualContext& context);

}  // namespace loopscope::core::model
