#pragma once

#include "core/diagnosis/evidence.hpp"
#include "core/diagnosis/verdict.hpp"
#include "core/hos/settings.hpp"
#include "core/loop/oscillation.hpp"
#include "core/loop/performance.hpp"
#include "core/signal/loop_window.hpp"
#include "core/signal/prepare.hpp"

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
inline constexpr int kAlgorithmRevision = 1;

/// The table of contents of core/: window in, evidence and verdict out. A window that cannot be
/// judged ends as `insufficient_data`, never as an exception; settings out of range and series of
/// different lengths throw std::invalid_argument.
[[nodiscard]] Diagnosis diagnose(const signal::LoopWindow& window, const AnalysisSettings& settings,
                                 const LoopFacts& facts = {});

}  // namespace loopscope::core
