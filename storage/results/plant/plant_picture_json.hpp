#pragma once

#include <span>
#include <string>

#include "storage/results/plant/plant_picture.hpp"

namespace loopscope::storage {

/// As plant_oscillation keeps them: an array of objects, whose keys are the members of the values.
/// What is not finite is null; values have the five digits that a picture shows.
[[nodiscard]] std::string leads_json(std::span<const PlantLead> leads);
[[nodiscard]] std::string traces_json(std::span<const PlantTrace> traces);

}  // namespace loopscope::storage
