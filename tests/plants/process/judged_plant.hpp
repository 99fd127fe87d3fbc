#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/plants/process/process_plant.hpp"

namespace loopscope::tests::process {

/// What core/plant made of one plant.
struct Judgement {
  Cause cause = Cause::none;
  std::size_t events = 0;
  std::size_t carriers = 0;        ///< loops that carry the oscillation
  std::size_t carriers_found = 0;  ///< of them in the event that has most of them
  std::size_t members = 0;         ///< of that event
  std::size_t untouched = 0;       ///< of them that the cause does not touch (below 2 %)
  bool found = false;              ///< an event holds a carrier
  bool source_first = false;       ///< of the members the true source is the most likely one
  bool named = false;              ///< a source is named
  bool named_right = false;
  double first_odds = 0.0;            ///< of the most likely answer, "none of them" included
  bool first_right = false;           ///< that answer is true
  std::vector<std::string> evidence;  ///< evidence_lines.hpp
};

/// Draws, diagnoses and judges one plant.
[[nodiscard]] Judgement judge_plant(PlantKind kind, Cause cause, std::uint64_t seed);

}  // namespace loopscope::tests::process
