#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace loopscope::storage {

/// One loop's past foretells another one's future.
struct PlantLead {
  std::int64_t from_loop_id = 0;
  std::int64_t to_loop_id = 0;
  double gain = 0.0;    ///< ln(error before / after) of the one-step forecast, >= 0
  double direct = 0.0;  ///< the same of what no other member tells as well; 0 = nothing, or unknown
};

/// What a reader is shown of one loop of a shared oscillation.
struct PlantTrace {
  std::int64_t loop_id = 0;
  std::int64_t start_us = 0;      ///< of the first value, microseconds UTC since 1970
  double step_s = 0.0;            ///< from one value to the next
  std::vector<double> error;      ///< sp - pv, pv units; NaN = not recorded
  std::vector<double> periods_s;  ///< of the spectrum, shortest first
  std::vector<double> power;      ///< there: share of the error's variance per unit of ln(period)
};

/// As plant_oscillation keeps them: an array of objects, whose keys are the members of the values.
/// What is not finite is null; values have the five digits that a picture shows.
[[nodiscard]] std::string leads_json(std::span<const PlantLead> leads);
[[nodiscard]] std::string traces_json(std::span<const PlantTrace> traces);

}  // namespace loopscope::storage
