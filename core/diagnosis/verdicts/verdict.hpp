#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace loopscope::core::diagnosis {

/// The closed list of verdicts; name() gives the word that users and scripts see.
enum class VerdictCode {
  healthy,
  valve_stiction,
  valve_deadband,
  valve_saturation,
  valve_characteristic,
  valve_oversized,
  process_nonlinearity,
  external_disturbance,
  process_change,
  sensor_fault,
  tight_tuning,
  sluggish_tuning,
  nonlinear_unexplained,
  unexplained,
  not_controlling,
  insufficient_data,
};

[[nodiscard]] std::string_view name(VerdictCode code);
/// The code of that name; nullopt = there is none.
[[nodiscard]] std::optional<VerdictCode> verdict_code(std::string_view name);

/// Every code, in the order above.
[[nodiscard]] std::span<const VerdictCode> all_verdict_codes();

/// One value for each cause in the catalogue's order, up to the last that has one; nullopt = not
/// weighed.
using PerCause = std::vector<std::optional<double>>;
/// Makes `values` longer where that is needed.
void set_cause(PerCause& values, VerdictCode code, double value);

/// One cause of the catalogue as the evidence weighs it. Causes may stand together.
struct CauseReport {
  VerdictCode code = VerdictCode::healthy;
  double probability = 0.0;            ///< 0 to 1
  double prior = 0.0;                  ///< the same before anything was measured
  std::vector<std::string> in_favour;  ///< what speaks for it, strongest first, with numbers
  std::vector<std::string> against;
  double evidence = 0.0;  ///< log odds beyond the prior by its own figures, whatever the others
};

/// What the evidence says about one loop, in words that can go into a work order.
struct Verdict {
  VerdictCode code = VerdictCode::insufficient_data;
  double confidence = 0.0;           ///< probability of the code, 0 to 1
  std::string summary;               ///< one sentence
  std::vector<std::string> reasons;  ///< each names its numbers
  std::string action;                ///< what to do next
  /// Probability of evidence as strong as what the verdict rests on, were the loop without that
  /// fault; 1 where its test was not computed. nullopt when it rests on a fact (op at its limit, a
  /// sensor's data, a recorded valve position, not in command), for `healthy`, `not_controlling`
  /// and `insufficient_data`.
  std::optional<double> p = std::nullopt;
  std::vector<CauseReport> causes = {};  ///< all that were weighed, the most probable first
  PerCause priors = {};  ///< by which it was judged, whether a cause was weighed or not
  /// A fact of this window (pv stands still, op at its limit): other windows take nothing from it,
  /// and it says nothing of what they show.
  bool stands_alone = false;
};

/// CauseReport::probability of the causes that were weighed.
[[nodiscard]] PerCause probabilities_of(const Verdict& verdict);

/// How often each cause is to be expected, 0 to 1; 0 = as in the simulated loops that the curves
/// were fitted on (cause_curves.hpp names those shares). `nonlinear_unexplained`, any of several,
/// keeps its own.
struct Priors {
  double healthy = 0.0;
  double valve_stiction = 0.0;
  double valve_deadband = 0.0;
  double valve_saturation = 0.0;
  double valve_characteristic = 0.0;
  double valve_oversized = 0.0;
  double process_nonlinearity = 0.0;
  double external_disturbance = 0.0;
  double process_change = 0.0;
  double sensor_fault = 0.0;
  double tight_tuning = 0.0;
  double sluggish_tuning = 0.0;
};

/// How causes become a verdict.
struct DecisionSettings {
  double line = 0.3;  ///< least probability of a cause that is named, 0 to 1
  Priors priors;
};

}  // namespace loopscope::core::diagnosis
