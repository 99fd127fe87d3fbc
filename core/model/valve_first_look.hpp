#pragma once

#include <cstddef>
#include <vector>

#include "core/model/valve_trial.hpp"

namespace loopscope::core::model {

/// Where valves show in a record, roughly.
struct FirstLook {
  std::vector<double> bands;  ///< S that op swings by, %, rising by 8 %
  std::size_t samples_per_row = 1;
  std::vector<Trial> trials;  ///< on the quick record at that rate, best first
};

/// First Kano's and the printed valve over all bands in wide steps, then the row length at which
/// the best of them show best, then every law with several J around the bands that lead.
[[nodiscard]] FirstLook look_first(ValveRecords& records);

}  // namespace loopscope::core::model
