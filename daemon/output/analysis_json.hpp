#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/diagnosis/diagnose.hpp"

namespace loopscope::daemon {

/// What the object `input` of `analyze --json` says.
struct InputFacts {
  std::string file;
  std::size_t samples = 0;           ///< of the window
  std::optional<double> interval_s;  ///< nullopt = fewer than two samples
  /// Of the first sample: ISO 8601, or seconds for a file with t_s; null = the window is empty.
  nlohmann::ordered_json start;
  nlohmann::ordered_json end;  ///< likewise of the last one
};

/// The whole diagnosis as the JSON object of contract.md; what is not computed is null.
[[nodiscard]] nlohmann::ordered_json analysis_json(const InputFacts& input,
                                                   const core::Diagnosis& diagnosis);

/// The object `hos_slow`: that of `hos` with the decimation and the span (raw samples), its peaks
/// in cycles per kept sample.
[[nodiscard]] nlohmann::ordered_json slow_look_json(const core::hos::SlowLook& look,
                                                    core::TestedOn tested_on);

/// The object `verdict`.
[[nodiscard]] nlohmann::ordered_json verdict_json(const core::diagnosis::Verdict& verdict);

/// The object as indented text in valid UTF-8, whatever bytes a file name holds: those that are no
/// UTF-8 become U+FFFD.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& object);

}  // namespace loopscope::daemon
