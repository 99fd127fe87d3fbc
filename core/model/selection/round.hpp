#pragma once

#include <vector>

#include "core/model/fit/trial.hpp"
#include "core/model/residual_tests/nominations.hpp"

namespace loopscope::core::model {

/// What a round tries.
enum class Reach {
  promising,  ///< what is asked for, but for what promises little beside an effect tried before
  asked,      ///< all that is asked for
  unasked,    ///< what nobody asked for
};

/// One round of a story: what is to be explained, and on which rows.
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

}  // namespace loopscope::core::model
