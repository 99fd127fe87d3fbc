#pragma once

#include <array>

namespace loopscope::storage::model_keys {

/// The keys of a loop model's JSON (`analysis.model`) that SQL takes out of it: who writes the JSON
/// names them by these, so that neither side changes alone. All other keys are for readers of
/// `analyze --json` and of exports only. A test compares them with the statements and the views.

/// Of the model.
inline constexpr const char* kSteps = "steps";
inline constexpr const char* kClosedLoop = "closed_loop";

/// Of one of its `steps`: columns of loopscope.explanation_step.
inline constexpr const char* kEffect = "effect";
inline constexpr const char* kParameters = "parameters";
inline constexpr const char* kIntervals = "intervals";
inline constexpr const char* kErrorBefore = "holdout_error_before";
inline constexpr const char* kErrorAfter = "holdout_error_after";
inline constexpr const char* kEvidence = "evidence";
inline constexpr const char* kP = "p";
inline constexpr const char* kMargin = "margin";
inline constexpr const char* kSimulationRatio = "simulation_ratio";
inline constexpr const char* kSteadiness = "steadiness";
inline constexpr const char* kStatement = "statement";
inline constexpr const char* kAskedBy = "asked_by";

/// Of its `closed_loop`: what the judgement of repairs compares.
inline constexpr const char* kControllerGain = "controller_gain";
inline constexpr const char* kIntegralTime = "integral_time_s";
inline constexpr const char* kControllerFit = "controller_fit";

inline constexpr std::array kAll{
    kSteps,           kClosedLoop,   kEffect,    kParameters, kIntervals,
    kErrorBefore,     kErrorAfter,   kEvidence,  kP,          kMargin,
    kSimulationRatio, kSteadiness,   kStatement, kAskedBy,    kControllerGain,
    kIntegralTime,    kControllerFit};

}  // namespace loopscope::storage::model_keys
