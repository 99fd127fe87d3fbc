#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

namespace loopscope::daemon {

/// How far two sets of figures are apart.
struct FigureComparison {
  std::size_t compared = 0;   ///< numbers, words, truths and nulls of the first set
  std::size_t different = 0;  ///< those that the second does not have to the last digit
  /// The one that is farthest apart; empty = none is. Where any differ by more than their digits
  /// (words, truths, null against a number), the first of those.
  std::string name;    ///< e.g. "steps/0/holdout_error_after"
  std::string before;  ///< as JSON
  std::string after;   ///< as JSON; "nothing" where the second set has no such figure
  /// |a - b| by the larger one of the two, 0 to 2; 2 where it is no matter of digits.
  double relative = 0.0;
};

/// Compares every figure of `before`, an object of any depth, with the one of the same name in
/// `after`. Words that differ in numbers only (the sentences about the figures) differ as far as
/// those do not: they are counted, but are never the farthest while a number differs.
[[nodiscard]] FigureComparison compare_figures(const nlohmann::json& before,
                                               const nlohmann::json& after);

}  // namespace loopscope::daemon
