#pragma once

#include <optional>

#include "core/model/fit/fit_variants.hpp"
#include "core/model/selection/round.hpp"

namespace loopscope::core::model {

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
