#pragma once

#include <vector>

#include "core/model/question_residual.hpp"
#include "core/model/trial.hpp"

namespace loopscope::core::model {

/// A fit as it was judged on rows that it had not seen.
struct Judged {
  TwinFit fit;
  Rows rows;
  bool once = false;  ///< on the score rows alone (contestant.hpp), else on those of both kinds
};

/// An effect that was taken in.
struct Chapter {
  TwinFit fit;                  ///< with it and all before it
  Comparison comparison;        ///< with it against without it
  double rival_evidence = 0.0;  ///< of the best effect of another cause in the same round
  double simulation_ratio = 1.0;
  Judged judged;  ///< what `comparison` has after it, before the process was settled behind it
};

/// From the linear loop to the last effect that the data ask for.
struct Story {
  LoopData data;  ///< with the rows on which the last fit is judged
  TwinFit baseline;
  std::vector<Chapter> chapters;
  Rows first_rows = data.rows;  ///< on which the baseline is judged
  [[nodiscard]] const TwinFit& last() const {
    return chapters.empty() ? baseline : chapters.back().fit;
  }
};

/// Fits the linear loop.
[[nodiscard]] Story begin_story(const LoopData& data);

/// Takes in one effect after the other, each time the one least probable by chance, as long as that
/// is significant. A valve is followed by pv only where the answers to the questions on the
/// baseline's residual call for it, and what the effects found since have left still does: that
/// search costs most.
void continue_story(Story& story, const std::vector<Answer>& answers);

}  // namespace loopscope::core::model
