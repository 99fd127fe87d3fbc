#pragma once

#include <optional>
#include <vector>

#include "core/model/fit/fit_variants.hpp"
#include "core/model/fit/trial.hpp"
#include "core/model/residual_tests/run_residual_tests.hpp"

namespace loopscope::core::model {

/// What a round tries.
enum class Reach {
  promising,  ///< what is asked for, but for what promises little beside an effect tried before
  asked,      ///< all that is asked for
  unasked,    ///< what nobody asked for
};

/// One round of the forward selection: what is to be explained, and on which rows.
struct Round {
  const LoopData& original;  ///< rows as laid out, before any step was seen by fit and score alike
  const LoopData& data;      ///< rows on which `now` is judged
  const CrossFit& now;
  const Nominations& asked;  ///< for by the residual tests
  bool load_steps_only =
      false;  ///< they come in groups: the next one before anything else is looked at
  Reach reach = Reach::promising;
};

/// An effect that was looked at, not yet fitted in full.
struct Candidate {
  EffectPtr effect;
  Structure structure;    ///< with it last; process and noise as they are, or by glance()
  double gain = 0.0;      ///< n ln(error before / after) on the rows that were looked at
  std::size_t tries = 1;  ///< how many of its kind were looked at on rows that score it
};

/// The original rows, with the samples around every load step and sudden change of gain of the
/// structure seen by fit and score.
[[nodiscard]] LoopData judged_on(const LoopData& original, const Structure& structure);

/// First looks at effects, one after the other: process and noise as they are, or a glance.
class EffectScreening {
 public:
  /// `round` has to outlive this.
  explicit EffectScreening(const Round& round);
  EffectScreening(const EffectScreening&) = delete;
  EffectScreening& operator=(const EffectScreening&) = delete;

  [[nodiscard]] Candidate at(const EffectPtr& effect);

  /// Behind an effect that bends op the process is another one.
  [[nodiscard]] Candidate through(const EffectPtr& effect) const;

  /// The place of a change, to a sample.
  void put_in_place(Candidate& candidate) const;

 private:
  /// Rows, and the error that the model as it stands leaves on them.
  struct View {
    LoopData rows;
    double before = 0.0;
  };

  [[nodiscard]] static View whole_view(const Round& round);
  [[nodiscard]] Candidate at_step(const EffectPtr& effect) const;
  [[nodiscard]] Candidate beside(const EffectPtr& effect);

  const Round& round_;
  View part_, whole_;
  std::optional<FitVariants> part_variants_, whole_variants_;
};

}  // namespace loopscope::core::model
