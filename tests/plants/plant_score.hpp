#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "tests/plants/plant.hpp"

namespace loopscope::tests::plants {

/// Of the faulty loops of one kind.
struct FaultScore {
  std::size_t faulty = 0;
  std::size_t right = 0;    ///< flagged with a verdict that is right for the kind
  std::size_t wrong = 0;    ///< flagged with the name of another cause
  std::size_t unnamed = 0;  ///< flagged, and said that the cause is not known
};

/// Faulty loops that are neither right, wrong nor unnamed are not on the list.
struct PlantScore {
  std::size_t loops = 0;
  std::size_t faulty = 0;
  std::size_t right = 0;
  /// Healthy loops that are flagged for whatever reason, and faulty ones that are accused of
  /// something else: each sends somebody out for nothing.
  std::size_t false_flags = 0;
  std::size_t false_healthy = 0;  ///< the healthy ones among them
  std::map<std::string, FaultScore> by_fault;
  /// "L017 healthy_still: tight_tuning" for every loop that is not as it should be.
  std::vector<std::string> misses;
};

/// Name of the loop to the verdict on the list.
using Flags = std::map<std::string, std::string>;

/// Throws std::invalid_argument for the name of a loop that the plant does not have.
[[nodiscard]] PlantScore score(const std::vector<PlantLoop>& plant, const Flags& flags);

}  // namespace loopscope::tests::plants
