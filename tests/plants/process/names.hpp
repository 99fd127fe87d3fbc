#pragma once

#include <string>
#include <vector>

#include "tests/plants/process/process_plant.hpp"

namespace loopscope::tests::process {

[[nodiscard]] std::string name_of(PlantKind kind);
[[nodiscard]] std::string name_of(Cause cause);
/// Throw std::invalid_argument.
[[nodiscard]] PlantKind kind_named(const std::string& name);
[[nodiscard]] Cause cause_named(const std::string& name);

[[nodiscard]] const std::vector<PlantKind>& all_kinds();
[[nodiscard]] const std::vector<Cause>& all_causes();

}  // namespace loopscope::tests::process
