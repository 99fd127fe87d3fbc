#pragma once

#include <optional>

#include "core/diagnosis/analysis_settings.hpp"
#include "core/diagnosis/evidence/evidence.hpp"
#include "core/diagnosis/first_look.hpp"
#include "core/diagnosis/loop_facts.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"
#include "core/model/record/model_input.hpp"
#include "core/model/results/explanation.hpp"
#include "core/model/traces.hpp"

namespace loopscope::core {

/// Whether the data allow a loop model. What the archive did to pv reads as load steps and bends
/// where little of it was stored. A slow sensor is an effect that the model knows.
[[nodiscard]] bool can_be_modelled(const FirstLook& first, const Evidence& evidence);

/// What has to be shown before a loop model is fitted by those who cannot afford one for every loop
/// of a plant.
struct ModelTrigger {
  double largest_p = 0.05;        ///< of the test behind a verdict that rests on one
  double least_confidence = 0.0;  ///< of the verdict
  /// Whether a verdict with this confidence, and this p where it rests on a test, is one.
  [[nodiscard]] bool given_by(diagnosis::VerdictCode code, double confidence,
                              std::optional<double> p) const;
};

/// Whether the evidence without a model gives cause to fit one.
[[nodiscard]] bool triggers_model(const Evidence& evidence, const AnalysisSettings& settings,
                                  const ModelTrigger& cause = {});

/// What core/model is given; views `first`, and `cycle` where it was judged before.
[[nodiscard]] model::ModelInput model_input(const FirstLook& first, const LoopFacts& facts,
                                            const model::CycleCause* cycle = nullptr);

/// What the loop model (core/model) makes of a window that can be modelled; nullopt = no model
/// was fitted. A pure function of the window, the settings behind `first` and the facts.
[[nodiscard]] std::optional<model::Explanation> explain_loop(
    const FirstLook& first, const LoopFacts& facts, const model::CycleCause* cycle = nullptr);

/// The same with the series behind it, for pictures; on the grid of `first.loop`.
[[nodiscard]] std::optional<model::ExplanationTraces> trace_loop(const FirstLook& first,
                                                                 const LoopFacts& facts);

}  // namespace loopscope::core
