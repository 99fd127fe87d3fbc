#pragma once

#include <string>
#include <vector>

#include "tests/plants/network/outcome.hpp"

namespace loopscope::tests::network {

/// Counts over plants; shares are quotients of two of them.
struct Summary {
  std::size_t plants = 0;        ///< with a source
  std::size_t found = 0;         ///< in which the shared oscillation was found
  std::size_t source_first = 0;  ///< in which the true source is ranked first
  std::size_t source_top3 = 0;
  std::size_t source_named = 0;  ///< in which a source is named at all
  std::size_t named_right = 0;
  std::size_t carriers = 0, carriers_found = 0;
  std::size_t members = 0, untouched = 0, victims_listed = 0;
  std::size_t own_valves = 0, own_valves_hidden = 0;  ///< as in Outcome
  std::size_t outside_plants = 0, outside_found = 0;
  std::size_t outside_named = 0;  ///< in which a source is named falsely
  std::size_t cascades = 0, cascades_found = 0, cascades_false = 0;
  double plant_ms = 0.0;  ///< mean time of core/plant on a plant
  std::vector<double> by_criterion;
  std::vector<Outcome> wrong;  ///< source not first, or named though outside
};

[[nodiscard]] Summary summarise(const std::vector<Outcome>& outcomes);

[[nodiscard]] std::string table_of(const Summary& summary);
[[nodiscard]] std::string json_of(const Summary& summary);

}  // namespace loopscope::tests::network
