#pragma once

#include <cstdint>
#include <ostream>
#include <vector>

#include "tests/plants/plant.hpp"

namespace loopscope::tests::plants {

/// Rows of a narrow historian table for COPY: tag, time in microseconds since 1970, value, by tabs.
/// Tags are the loop's name with .SP, .PV and .OP. The last sample lies at `end_us`; that of the
/// stretch before (`stretch` = 1) one window earlier.
void write_history(std::ostream& out, const std::vector<PlantLoop>& loops, std::uint64_t stretch,
                   std::int64_t end_us);

/// The catalogue for `loopscope loops load`: all that an engineer knows of the loops, no truth. A
/// window is analysed after each window, so that two of them share no sample.
void write_catalogue(std::ostream& out, const std::vector<PlantLoop>& loops);

/// The loops that have a second, earlier window: all faulty ones and as many healthy ones.
[[nodiscard]] std::vector<PlantLoop> watched_before(const std::vector<PlantLoop>& plant);

}  // namespace loopscope::tests::plants
