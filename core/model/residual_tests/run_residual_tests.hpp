#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/model/fit/fit.hpp"
#include "core/model/record/loop_data.hpp"
#include "core/model/residual_tests/statistics/residual_context.hpp"
#include "core/model/residual_tests/statistics/test_outcome.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::core::model {

/// What is left after the fit, put to the residual tests, in this order: white, op_dynamics,
/// op_direction, op_level, response_level, time_gain, time_spread, time_event, periodic, grid,
/// held. One that cannot be made (no op, op constant, too many gaps) is left out; empty when fewer
/// than 200 innovations are there or they do not vary.
///
/// Each p is that of its own test; the tests are not corrected for each other. Throws
/// std::invalid_argument when the spans differ in length or the sample interval is not positive.
[[nodiscard]] std::vector<TestOutcome> test_residual(const ResidualView& view);

/// The model run on op alone, pv units.
[[nodiscard]] std::vector<double> response_of(const LoopData& data, const Fit& fit);

/// What the one-step errors of a fit still hold, by the residual tests. `data` and `fit` are of the
/// record in `input`.
[[nodiscard]] std::vector<TestOutcome> run_residual_tests(const ModelInput& input,
                                                          const LoopData& data, const Fit& fit);
/// The same by the tests of core/hos, which cost more than the others together: nonlinear, ngi
/// (tests/coupling.hpp). `seed` drives the simulations behind their p-values.
[[nodiscard]] std::vector<TestOutcome> run_coupling_tests(const LoopData& data, const Fit& fit,
                                                          std::uint64_t seed);

/// At this p a residual test asks for effects: one healthy loop in a hundred and test.
inline constexpr double kNominates = 0.01;

/// The effects that the residual tests ask for, by what they promise. Twice the negative logarithm
/// of a test's p is what an effect that explains all that the test saw would come to in evidence:
/// in that measure tests of any kind compare, so that they are ranked by p. They are tried in that
/// order (selection_round.cpp); the rank stands in the results.
class Nominations {
 public:
  explicit Nominations(const std::vector<TestOutcome>& answers);
  /// Tests only: what another loop's residual asked for.
  explicit Nominations(std::span<const Nomination> nominations);

  /// A valve that sticks and one that has play are asked for together.
  [[nodiscard]] bool for_effect(EffectKind effect) const { return rank(effect) > 0; }
  /// 1 = the most promising; 0 = nobody asks for it.
  [[nodiscard]] std::size_t rank(EffectKind effect) const;
  /// Twice the negative logarithm of the smallest p that asks for it; 0 = nobody asks.
  [[nodiscard]] double promise(EffectKind effect) const;
  /// Those of one effect, the most promising first.
  [[nodiscard]] std::vector<Nomination> nominations(EffectKind effect) const;
  /// Whether a test points to it at kSignificant, if not at kNominates.
  [[nodiscard]] bool hints_at(EffectKind effect) const;

 private:
  void add(const Nomination& nomination);
  void order();

  std::vector<Nomination> nominations_;
  std::vector<EffectKind> hints_;
};

/// The tests among `before` that ask for the effect, with what they say once it is in.
[[nodiscard]] std::vector<AskedBy> asked_by(EffectKind effect,
                                            const std::vector<TestOutcome>& before,
                                            const std::vector<TestOutcome>& after);

/// Of what the tests saw that asked for an effect, the share that they still see with it in the
/// model, 0 to 1: ln p after by ln p before, over all of them. 0 where nobody asked.
[[nodiscard]] double share_left(const std::vector<AskedBy>& asked_by);

/// In the results' words.
[[nodiscard]] std::vector<AskedEffect> asked_effects(const std::vector<TestOutcome>& answers);

}  // namespace loopscope::core::model
