#pragma once

#include <cstdint>
#include <istream>
#include <string>
#include <vector>

#include "tests/plants/plant_score.hpp"

namespace loopscope::tests::plants {

struct SeedScore {
  std::uint64_t seed = 0;
  PlantScore score;
};

/// What the figure asks of a plant: 22 of 25 right, at most two false.
[[nodiscard]] bool holds(const PlantScore& score);

/// A line a plant, then the faults over all plants, then what was missed.
[[nodiscard]] std::string table_of(const std::vector<SeedScore>& scores);
[[nodiscard]] std::string json_of(const std::vector<SeedScore>& scores);

/// Lines "NAME VERDICT". Throws std::invalid_argument for any other.
[[nodiscard]] Flags read_flags(std::istream& lines);

}  // namespace loopscope::tests::plants
