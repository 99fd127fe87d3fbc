#pragma once

#include <functional>
#include <optional>

#include "core/diagnosis/analysis_settings.hpp"
#include "core/diagnosis/evidence/evidence.hpp"
#include "core/diagnosis/first_look.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"
#include "core/model/record/loop_data.hpp"
#include "core/model/results/explanation.hpp"
#include "core/model/traces.hpp"
#include "core/signal/loop_window.hpp"

namespace loopscope::core {

/// Whether the data allow a loop model. What the archive did to pv reads as load steps and bends
/// where little of it was stored. A slow sensor is an effect that the model knows.
[[nodiscard]] bool can_be_modelled(const FirstLook& first, const Evidence& evidence);

/// What has to be shown before a loop model is fitted by those who cannot afford one for every loop
/// of a plant.
struct ModelTrigger {
  double largest_p = 0.05;        ///< of the test behind a verdict that rests on one, 0 to 1
  double least_confidence = 0.0;  ///< of the verdict, 0 to 1
  /// Whether a verdict with this confidence, and this p where it rests on a test, is one; never one
  /// that names no fault.
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

/// Evidence and what follows from it.
struct Diagnosis {
  Evidence evidence;
  diagnosis::Verdict verdict;
  /// The series behind the explanation, where they were wished (ModelPlan::traces).
  std::optional<model::ExplanationTraces> traces;
};

/// What a diagnosis goes through, one after the other.
enum class Stage { statistics, model, verdict };

/// When a diagnosis fits a loop model, and what it keeps of it.
struct ModelPlan {
  /// nullopt: where the data allow one. Else only where the statistics give this cause too.
  std::optional<ModelTrigger> cause;
  bool traces = false;              ///< with the series behind it, for pictures
  std::function<void(Stage)> done;  ///< called when a stage ends; of the model, if one was fitted
};

/// Raised whenever the same window and settings may give another diagnosis than before: part of
/// the key of every stored analysis.
inline constexpr int kAlgorithmRevision = 32;

/// The table of contents of core/: window in, evidence and verdict out. A window that cannot be
/// judged ends as `insufficient_data`, never as an exception; settings out of range and series of
/// different lengths throw std::invalid_argument.
///
/// `long_window` is the same loop up to the same end over a longer span: the slow look is taken on
/// it instead of the window, everything else on the window. Its interval has to be the window's
/// (std::invalid_argument). A loop model is fitted where the settings, the data and `plan` have
/// one.
[[nodiscard]] Diagnosis diagnose(const signal::LoopWindow& window, const AnalysisSettings& settings,
                                 const LoopFacts& facts = {},
                                 const signal::LoopWindow* long_window = nullptr);

/// The same from a first look at the window, taken with the same settings.
[[nodiscard]] Diagnosis diagnose(const FirstLook& first, const AnalysisSettings& settings,
                                 const LoopFacts& facts = {},
                                 const signal::LoopWindow* long_window = nullptr,
                                 const ModelPlan& plan = {});

}  // namespace loopscope::core
