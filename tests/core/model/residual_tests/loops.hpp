#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/model/residual_tests/statistics/residual_context.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"
#include "core/simulate/loop.hpp"

namespace loopscope::core::model::tests {

using Series = std::vector<double>;

/// White residuals: what a right model leaves.
enum class White { gaussian, exponential, laplace, modulated, garch, garch_laplace };
[[nodiscard]] std::string_view name(White kind);
[[nodiscard]] Series white(White kind, std::size_t samples, std::uint64_t seed);

/// Adds amplitude sin(2 pi k / period).
void add_sinusoid(Series& signal, double period, double amplitude);

/// What a ResidualView looks at.
struct Questionable {
  Series innovation, op_percent, op_direction, response, pv;
  double sample_interval_s = 1.0;
  [[nodiscard]] ResidualView view() const;
};

/// A first-order process with two samples of delay under PI control, with setpoint moves and noise
/// (1 - 0.5 z^-1) / (1 - 0.98 z^-1) r, so that the true model's innovations are `innovation`.
[[nodiscard]] Questionable closed_loop(const Series& innovation, std::uint64_t seed);

/// The residual of a least-squares ARX model (3 lags of pv, 10 of op) of a record, and the model's
/// output run on op alone.
[[nodiscard]] Questionable arx_residual(const simulate::LoopRecord& record);

/// p of the question of that name; NaN when it was not asked.
[[nodiscard]] double p_of(const std::vector<TestOutcome>& answers, std::string_view question);
/// nullptr when it was not asked.
[[nodiscard]] const TestOutcome* answer_of(const std::vector<TestOutcome>& answers,
                                           std::string_view question);
/// nullptr when the question did not nominate it.
[[nodiscard]] const Nomination* nomination_of(const std::vector<TestOutcome>& answers,
                                              std::string_view question, EffectKind effect);

}  // namespace loopscope::core::model::tests
