#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "core/model/results/explanation.hpp"

namespace loopscope::core::model {

/// An effect that would leave what a question found, and where a search for it may start.
struct Nomination {
  EffectKind effect = EffectKind::load_step;
  double p = 1.0;  ///< of the part of the question that points to this effect
  std::optional<std::size_t> at_sample =
      std::nullopt;  ///< load_step, gain_change, sensor_hold: where it begins
  std::optional<double> size =
      std::nullopt;  ///< load_step, pv units, signed; at least the sign is right
  std::optional<double> gain_ratio = std::nullopt;      ///< gain_change: after / before, rough
  std::optional<double> period_samples = std::nullopt;  ///< external_oscillation
  std::optional<double> amplitude =
      std::nullopt;                           ///< external_oscillation: of the line in pv, pv units
  std::optional<double> step = std::nullopt;  ///< sensor_quantisation, pv units
  std::optional<double> hold_samples = std::nullopt;  ///< sensor_hold
  std::optional<double> low_percent = std::nullopt;   ///< valve_saturation, % of op
  std::optional<double> high_percent = std::nullopt;  ///< valve_saturation, % of op
};

/// A question with its nominations, strongest first; none unless p <= kSignificant.
struct TestOutcome {
  Question question;
  std::vector<Nomination> nominations;
};

/// A question has found something at this p: what the statements and nominations go by. The caller
/// knows how many questions it asks and draws its own line below.
inline constexpr double kSignificant = 0.05;

/// p of the question of that name; 1 when it was not asked.
[[nodiscard]] inline double p_of(const std::vector<TestOutcome>& answers,
                                 std::string_view question) {
  for (const TestOutcome& answer : answers) {
    if (answer.question.name == question) return answer.question.p;
  }
  return 1.0;
}

}  // namespace loopscope::core::model
