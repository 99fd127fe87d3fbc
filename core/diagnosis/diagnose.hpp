#pragma once

#include <functional>
#include <optional>

#include "core/diagnosis/analysis_settings.hpp"
#include "core/diagnosis/evidence/evidence.hpp"
#include "core/diagnosis/first_look.hpp"
#include "core/diagnosis/loop_facts.hpp"
#include "core/diagnosis/loop_model.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"
#include "core/model/traces.hpp"
#include "core/signal/loop_window.hpp"

namespace loopscope::core {

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
inline constexpr int kAlgorithmRevision = 27;

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
