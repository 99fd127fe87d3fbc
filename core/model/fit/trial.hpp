#pragma once

#include "core/model/fit/fit.hpp"

namespace loopscope::core::model {

/// A structure fitted twice, each time to the rows that the other is scored on.
struct CrossFit {
  Fit fit;         ///< on the fit rows
  Fit other_fold;  ///< on the score rows, from where `fit` ended
};
[[nodiscard]] CrossFit cross_fit(const LoopData& data, Fit fit);

/// How much better one fit predicts than another on rows that it has not seen, or that both halves
/// see; each counts once. Errors in units of pv_scale squared.
struct Comparison {
  double before = 0.0;  ///< mean square of the held-out one-step errors
  double after = 0.0;
  double evidence = 0.0;  ///< n ln(before / after)
  /// Of the split likelihood ratio (Wasserman, Ramdas and Balakrishnan 2020): a model fitted on one
  /// half is exp(evidence / 2) times likelier than the null on the other half with at most the
  /// probability exp(-evidence / 2), however long the search was that found it. That holds for one
  /// half; over both the share at 0.001 was measured to be 0.0015 at most.
  double p = 1.0;
  double steadiness = 0.0;  ///< share of the eighths of the record in which the error falls, 0 to 1
};
/// `once`: on the score rows alone. p = 1 without rows.
[[nodiscard]] Comparison compare(const LoopData& data, const CrossFit& before,
                                 const CrossFit& after, bool once = false);

/// Both fits of a structure that stands, on other rows.
[[nodiscard]] CrossFit reevaluated(const LoopData& rows, const CrossFit& fit);

/// Whether the last effect, of which there is one, does no more than such an effect in a plant.
[[nodiscard]] bool is_plausible(const Fit& fit);

/// n ln(before / after) of errors on the fit rows; -infinity where numbers have overflown.
[[nodiscard]] double gain_of(const LoopData& data, double before, double after);
/// The error on the fit rows that is left of `before` by such a gain.
[[nodiscard]] double error_after(const LoopData& data, double before, double gain);
/// gain_of() of two fits.
[[nodiscard]] double fit_gain(const LoopData& data, const Fit& before, const Fit& after);

/// Parameters of the last effect by coordinate search, process and noise as they are; moves
/// from `coarsest` (see Effect::neighbours) down.
[[nodiscard]] Fit refine_last(const LoopData& data, Fit fit, double coarsest = 1.0);

}  // namespace loopscope::core::model
