#pragma once

#include "core/model/explanation.hpp"

namespace loopscope::core::diagnosis {

/// p of "nothing is left in the residual": the smallest of whiteness and the questions, times their
/// number (Bonferroni), 0 to 1.
[[nodiscard]] double structure_p(const model::Explanation& explanation);

/// The model leaves something behind that is clearly not noise.
[[nodiscard]] bool leaves_structure(const model::Explanation& explanation);

/// `confidence` held to what a model may claim that leaves structure behind.
[[nodiscard]] double held_by_structure(double confidence, const model::Explanation& explanation);

/// Confidence, 0 to 1, in the verdict of the leading effect; 0 without a step. The product of five
/// factors, each 0 to 1, times the most that a model may claim:
///
///     evidence     1 - exp(-E / scale) of the verdict's strongest step: saturates
///     margin       1 / (1 + exp(-m / scale)) over the best rival of another verdict: one half
///                  when the rival is as good, as of two hypotheses of equal weight
///     steadiness   from one half (in no part of the record) to 1 (in every part); an effect that
///                  happens once (load step, gain change) owes none
///     explained    share of the explainable error that is explained, 1 - unexplained.fraction,
///                  from kNothingExplained to 1
///     agreement    share of the leading verdict in what all steps explain, halved and raised by
///                  one half: of two verdicts of equal weight the choice is a toss
///
/// and at most kMostWithStructure where the residual is still structured. The constants are set
/// against measured hit rates (tests/effects).
[[nodiscard]] double confidence_of(const model::Explanation& explanation);

/// How often a loop without the step's effect shows as much: min(1, 0.02 exp(-E / 25)), E the
/// evidence, and never below the step's own p. That one is exact for a loop that the linear model
/// can be; vessels whose level is moved far, and delays that are no whole number of samples, are
/// not quite such loops. Measured on healthy loops of tests/effects (README.md).
[[nodiscard]] double measured_p(const model::Step& step);

}  // namespace loopscope::core::diagnosis
