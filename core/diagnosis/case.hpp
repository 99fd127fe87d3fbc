#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnosis/evidence.hpp"
#include "core/diagnosis/nonlinearity.hpp"
#include "core/diagnosis/valve_pattern.hpp"
#include "core/diagnosis/verdict.hpp"

namespace loopscope::core::diagnosis {

/// Evidence with what follows from it, as the branches of the decision flow read it. Refers to the
/// evidence, which has to outlive it; evidence.hos is filled.
struct Case {
  const Evidence& evidence;
  NonlinearityFinding nonlinearity;
  ValvePattern valve;
};

[[nodiscard]] bool has_flag(const Evidence& evidence, std::string_view flag);

/// op was recorded and moves: without that nothing is claimed of controller and valve.
[[nodiscard]] bool op_speaks(const Evidence& evidence);

/// An oscillation is present and carries enough of the error's variance to matter.
[[nodiscard]] bool oscillates(const Evidence& evidence);

/// op moves by fractions of a percent while pv swings (paper, section 6.2.1).
[[nodiscard]] bool oversized(const Evidence& evidence);

/// Both spans in a sentence; `gain` has them.
[[nodiscard]] std::string oversized_text(const loop::ValveGain& gain);

/// The error creeps: the middle of the Harris range is far below that of a well tuned loop. False
/// for integrating loops, which are often meant to be slow, and where it was not measured.
[[nodiscard]] bool creeps(const Evidence& evidence);

/// Geometric middle of the Harris range; nullopt for integrating loops and where not measured.
[[nodiscard]] std::optional<double> middle_harris(const Evidence& evidence);

/// Confidence that a coarse grid of pv is what is wrong, seen and not inferred.
inline constexpr double kGridConfidence = 0.5;

/// Confidence that such a loop is slow, where nothing is known of its controller: 0.1 at the line,
/// 0.28 where nothing of the best is reached. Good loops under a load that drifts are as far from
/// the best: never enough for a flag (README.md). Requires creeps().
[[nodiscard]] double creeping_confidence(const Evidence& evidence);

/// The Harris range in a sentence; middle_harris() is not nullopt.
[[nodiscard]] std::string harris_text(const Evidence& evidence);

/// The autocorrelation keeps its height: a line drives the oscillation.
[[nodiscard]] bool sustained(const Evidence& evidence);

/// pv lies on a coarse grid, in a sentence.
[[nodiscard]] std::string quantisation_text(const Evidence& evidence);

/// Coupling was found and is what the loop is about. One linear loop in twenty shows coupling at
/// the level of the paper by chance: where such a weak finding meets a clearer oscillation, the
/// loop is about the oscillation.
[[nodiscard]] bool coupling_leads(const Case& loop);

/// What every verdict of the flow gives as reasons: the bispectrum, the oscillation, the valve.
[[nodiscard]] std::vector<std::string> reasons_of(const Case& loop);

/// `reasons` with one more.
[[nodiscard]] std::vector<std::string> with(std::vector<std::string> reasons, std::string reason);

/// A verdict in the words of its code, the confidence held to 0 to 1; `p` as in Verdict.
[[nodiscard]] Verdict make(VerdictCode code, double confidence, std::vector<std::string> reasons,
                           std::optional<double> p = std::nullopt);

/// p of the oscillation, where it is one that counts.
[[nodiscard]] std::optional<double> oscillation_p(const Evidence& evidence);

/// p of a verdict that either the coupling or the oscillation would carry alone: the smaller one.
[[nodiscard]] double coupling_or_oscillation_p(const Case& loop);

/// The verdict on an oversized valve, which both branches may reach; `p` is the branch's.
[[nodiscard]] Verdict oversized_valve(const Case& loop, std::optional<double> p);

}  // namespace loopscope::core::diagnosis
