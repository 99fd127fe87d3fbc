#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/effects/draws.hpp"

namespace loopscope::tests::effects {

/// Shares are 0 to 1; nullopt where there is nothing to take it from.
struct KindSummary {
  std::string kind;
  Group group = Group::healthy;
  std::size_t draws = 0;
  std::optional<double> named_right;  ///< share, of the draws with a model
  double verdict_right = 0.0;
  std::optional<double> all_found;
  std::optional<double> parameter_error;           ///< median over all of the below
  std::map<std::string, double> parameter_errors;  ///< medians, "effect.parameter"
  std::optional<double> explainable;               ///< median of the records' own
  std::optional<double> error_before;              ///< medians of one-step errors by the true floor
  std::optional<double> error_after;
  std::optional<double> model_floor;
  std::optional<double> explained;           ///< median of (before - after) / (before - floor)
  std::map<std::string, std::size_t> named;  ///< first steps, "-" = none
  std::map<std::string, std::size_t> verdicts;
};

struct Summary {
  std::vector<KindSummary> kinds;
  std::optional<double> accuracy;               ///< right verdicts, kinds of the catalogue
  std::optional<double> named_accuracy;         ///< right first steps of kinds with effects
  std::optional<double> false_on_healthy;       ///< valve, process or sensor accused
  std::optional<double> both_found;             ///< of pairs
  std::optional<double> overconfident_unknown;  ///< wrong cause, confidence above 0.6
  std::optional<double> confident_right;        ///< right verdicts with confidence above 0.6
  std::optional<double> brier;                  ///< of confidence as the probability of being right
  std::optional<double> model_ms;               ///< median of a whole diagnosis
};

[[nodiscard]] Summary summarise(const Plan& plan,
                                const std::vector<std::vector<Outcome>>& outcomes);

/// A table for people; one JSON object for scripts.
[[nodiscard]] std::string table_of(const Summary& summary);
[[nodiscard]] std::string json_of(const Summary& summary);
/// A line of JSON for each draw, for paired comparisons.
[[nodiscard]] std::string lines_of(const Plan& plan,
                                   const std::vector<std::vector<Outcome>>& outcomes);

}  // namespace loopscope::tests::effects
