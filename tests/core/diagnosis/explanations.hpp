#pragma once

#include <optional>
#include <vector>

#include "core/diagnosis/evidence/evidence.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::core::diagnosis {

/// A step with plenty of evidence, no close rival, steady over the record.
[[nodiscard]] model::Step clear_step(model::EffectKind effect, double before = 1.0,
                                     double after = 0.5);

/// An excited model that leaves white noise behind, with these steps.
[[nodiscard]] model::Explanation explanation_of(std::vector<model::Step> steps = {});

/// Implied closed loops: of period 60 s with little damping, well damped, very slow.
[[nodiscard]] model::ClosedLoop ringing_loop();
[[nodiscard]] model::ClosedLoop calm_loop();
[[nodiscard]] model::ClosedLoop slow_loop();

/// A full-length record without coupling, oscillation or odd data.
[[nodiscard]] Evidence quiet_evidence();
/// One that passes Harris' test as well, with this model.
[[nodiscard]] Evidence evidence_with(std::optional<model::Explanation> model);

inline constexpr double kOscillationP = 1e-6;
/// Adds an oscillation that carries most of the error's variance.
void oscillate(Evidence& evidence, double period_s, double persistence = 0.95);

}  // namespace loopscope::core::diagnosis
