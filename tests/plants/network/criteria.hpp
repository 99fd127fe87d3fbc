#pragma once

#include <string>
#include <vector>

#include "core/plant/shared_oscillation.hpp"
#include "core/plant/source_evidence.hpp"
#include "tests/plants/network/diagnosed.hpp"

namespace loopscope::tests::network {

/// What the source could be ranked by, besides what core/plant does: each of the published figures
/// and of ours alone. In the order of criterion_names(); the larger the more likely the source.
using Criteria = std::vector<double>;

[[nodiscard]] const std::vector<std::string>& criterion_names();

/// Of one member of an event. `lag_s` and `evidence` as core/plant has them.
[[nodiscard]] Criteria measure_criteria(const DiagnosedLoop& loop, double period_s,
                                        const core::plant::SharingLoop& member,
                                        const core::plant::SourceEvidence& evidence);

}  // namespace loopscope::tests::network
