#pragma once

#include <vector>

#include "tests/plants/diagnosed_loop.hpp"
#include "tests/plants/plant_score.hpp"

namespace loopscope::tests::plants {

/// Settings as a plant gets them that sets none (config/SETTINGS.md, /flags;
/// storage/results/reports/README.md).
struct FlagRule {
  double false_discovery_rate = 0.005;
  double min_confidence = 0.3;
  double list_false_share = 0.03;
  double list_leave_share = 0.2;
  double list_least_probability = 0.8;
  double list_leave_probability = 0.5;
  double enough_windows = 2.0;
};

/// Which loops the view flagged_loop would show, in their order: core/plant/README.md.
[[nodiscard]] std::vector<bool> flagged(const std::vector<DiagnosedLoop>& loops,
                                        const FlagRule& rule = {});

/// The same of a list that holds the loops `on_list` already (empty = none).
[[nodiscard]] std::vector<bool> flagged_after(const std::vector<DiagnosedLoop>& loops,
                                              const std::vector<bool>& on_list,
                                              const FlagRule& rule = {});

/// The same by name.
[[nodiscard]] Flags flags_of(const std::vector<PlantLoop>& plant,
                             const std::vector<DiagnosedLoop>& loops, const FlagRule& rule = {});

}  // namespace loopscope::tests::plants
