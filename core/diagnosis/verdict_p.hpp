#pragma once

#include <optional>

#include "core/diagnosis/evidence/evidence.hpp"
#include "core/diagnosis/verdicts/verdict.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::core::diagnosis {

/// How often a loop without the step's effect shows as much: 0.02 exp(-E / 25), E the evidence, and
/// never below the step's own p; 1 for E below 0. That one is exact for a loop that the linear
/// model can be; vessels whose level is moved far, and delays that are no whole number of samples,
/// are not quite such loops. Measured on healthy loops of tests/plants (MEASURED.md).
[[nodiscard]] double measured_p(const model::Step& step);

/// Verdict::p of this code: of the test that shows the cause most clearly. nullopt where a fact
/// shows it, and of codes that claim nothing.
[[nodiscard]] std::optional<double> p_of_verdict(VerdictCode code, const Evidence& evidence);

}  // namespace loopscope::core::diagnosis
