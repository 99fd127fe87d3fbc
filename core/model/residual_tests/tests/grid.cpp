#include "core/model/residual_tests/tests/grid.hpp"

#include "core/model/results/phrases.hpp"

namespace loopscope::core::model {
std::optional<TestOutcome> test_grid(const ResidualContext& context) {
  if (!context.pv) return std::nullopt;
  const double noise_std = context.fast_noise_std;
  const ValueGrid& grid = context.grid;
  const bool coarse = grid.step >= kHarmlessStep * noise_std;
  TestOutcome answer{{"grid", coarse ? grid.p : 1.0, {}}, {}};
  if (answer.question.p > kSignificant) return answer;
  answer.question.statement = "pv moves in steps of " + in_digits(grid.step) + " pv units (" +
                              std::to_string(grid.levels) + " values), " +
                              in_digits(grid.step / noise_std) + " times its fast noise.";
  answer.nominations = {
      {.effect = EffectKind::sensor_quantisation, .p = grid.p, .step = grid.step}};
  return answer;
}

}  // namespace loopscope::core::model
