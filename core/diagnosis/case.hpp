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
