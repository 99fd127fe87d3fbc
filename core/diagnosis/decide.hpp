#pragma once

#include "core/diagnosis/evidence.hpp"
#include "core/diagnosis/verdict.hpp"
#include "core/hos/settings.hpp"

namespace loopscope::core::diagnosis {

/// The decision flow of the paper's figure 1 (its text: sections 1, 3 and 5), from evidence to
/// verdict:
///
///     usable? -> pv frozen or held? -> op at its limit? -> setpoint
///       followed at all? -> valve position recorded and faulty?
///       -> loop model fitted and excited? yes -> model_verdict()
///       -> NGI, NLI: nonlinear?  yes -> oversized? sticking? valve acquitted? else unexplained
///                                no  -> oscillating? sticking (odd-symmetric)? sustained from
///                                       outside? tight tuning;  else slow? healthy
///          (in place of tuning and health what a model without excitation saw come from outside)
///
/// Confidence is 0 to 1 and falls with short records. Never throws.
[[nodiscard]] Verdict decide(const Evidence& evidence, const hos::Settings& settings);

}  // namespace loopscope::core::diagnosis
