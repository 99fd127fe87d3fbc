#pragma once

#include "core/diagnosis/evidence.hpp"
#include "core/diagnosis/verdict.hpp"
#include "core/hos/settings.hpp"
#include "core/loop/oscillation.hpp"
#include "core/loop/performance.hpp"
#include "core/signal/loop_window.hpp"
#include "core/signal/prepare.hpp"
#include "core/signal/prepared_loop.hpp"

namespace loopscope::core {

/// Settings of the whole analysis; each room documents its own.
struct AnalysisSettings {
  signal::PrepareSettings prepare;
  hos::Settings hos;
  loop::OscillationSettings oscillation;
  loop::PerformanceSettings performance;
};

/// What is known of a loop beside its samples.
struct LoopFacts {
  bool integrating = false;  ///< level loop: the vessel integrates
};

/// Evidence and what follows from it.
struct Diagnosis {
  Evidence evidence;
  diagnosis::Verdict verdict;
};

/// Raised whenever the same window and settings may give another diagnosis than before: part of
/// the key of every stored analysis.
inline constexpr int kAlgorithmRevision = 2;

/// A window made ready, and what has to be known of it before more of the history is asked for.
struct FirstLook {
  signal::PreparedLoop loop;
  loop::Oscillation oscillation;      ///< of the error; empty when the data are not usable
  std::size_t slow_span_samples = 0;  ///< as in Evidence
};

/// The part of diagnose() that comes before all other figures. Throws as diagnose() does.
[[nodiscard]] FirstLook first_look(const signal::LoopWindow& window,
                                   const AnalysisSettings& settings);

/// The table of contents of core/: window in, evidence and verdict out. A window that cannot be
/// judged ends as `insufficient_data`, never as an exception; settings out of range and series of
/// different lengths throw std::invalid_argument.
///
/// `long_window` is the same loop up to the same end over a longer span: the slow look is taken on
/// it instead of the window, everything else on the window. Its interval has to be the window's
/// (std::invalid_argument).
[[nodiscard]] Diagnosis diagnose(const signal::LoopWindow& window, const AnalysisSettings& settings,
                                 const LoopFacts& facts = {},
                                 const signal::LoopWindow* long_window = nullptr);

/// The same from a first look at the window, taken with the same settings.
[[nodiscard]] Diagnosis diagnose(const FirstLook& first, const AnalysisSettings& settings,
                                 const LoopFacts& facts = {},
                                 const signal::LoopWindow* long_window = nullptr);

}  // namespace loopscope::core
