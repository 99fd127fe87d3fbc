#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "core/diagnosis/diagnose.hpp"
#include "core/signal/loop_window.hpp"

namespace loopscope::storage {

/// One analysis as it is stored: keys, provenance and the diagnosis itself.
struct AnalysisRecord {
  std::int64_t slot_end_us = 0;  ///< microseconds UTC; the key together with loop and revision
  int algorithm_revision = core::kAlgorithmRevision;
  std::int64_t window_start_us = 0;                            ///< first sample of the window
  std::int64_t window_end_us = 0;                              ///< last sample of the window
  std::size_t samples = 0;                                     ///< grid slots in the window
  double sample_interval_s = 0.0;                              ///< 0 = unknown (no rows)
  std::optional<core::signal::PvPast> pv_past = std::nullopt;  ///< as known before the window
  std::string input_digest;  ///< 16 hexadecimal digits over all samples read, and settings
  std::string program_version;
  std::string settings_json;       ///< the analysis settings in force, as a JSON object
  double fetch_ms = 0.0;           ///< share of the batch's reading time
  double analyse_ms = 0.0;         ///< all of the analysis: the next three and the verdict
  double prepare_ms = 0.0;         ///< masks, gaps, archive, oscillation
  double statistics_ms = 0.0;      ///< higher-order statistics, shapes, performance
  std::optional<double> model_ms;  ///< the loop model; nullopt = none was fitted
  core::Diagnosis diagnosis;
  std::string hos_slow_json;  ///< the slow look as a JSON object; empty = there is none
  /// The loop model's story as the JSON object "model" of `analyze --json`; empty = there is none.
  /// Its steps become rows of explanation_step.
  std::string model_json;
};

}  // namespace loopscope::storage
