#pragma once

#include <cstdint>
#include <vector>

#include "core/diagnosis/verdicts/verdict.hpp"
#include "storage/catalogue_entry.hpp"

namespace loopscope::storage {

class Session;

/// A loop that may share an oscillation with others, as its newest analysis has it.
struct PlantCandidate {
  CatalogueEntry loop;
  std::int64_t slot_end_us = 0;      ///< of that analysis, microseconds UTC since 1970
  bool oscillating = false;          ///< by itself
  core::diagnosis::Verdict verdict;  ///< code, confidence, probabilities of the causes
};

/// Enabled loops whose newest analysis is usable and lies no more than three of their periods
/// before `slot_end_us`: those that oscillate first, the strongest evidence first; `limit` at most.
/// Microseconds UTC. One transaction; throws DatabaseError.
[[nodiscard]] std::vector<PlantCandidate> plant_candidates(Session& session,
                                                           std::int64_t slot_end_us,
                                                           std::int64_t limit);

}  // namespace loopscope::storage
