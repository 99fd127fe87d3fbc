#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "storage/connection_settings.hpp"
#include "storage/error.hpp"

namespace loopscope::storage {

/// What goes with loops that are deleted, or would go with them.
struct LoopsDeletion {
  std::size_t loops = 0;               ///< of these names
  std::size_t with_results = 0;        ///< loops that have any of the following
  std::size_t analyses = 0;            ///< with their peaks, steps and verdicts
  std::size_t annotations = 0;         ///< what people said of them
  std::size_t maintenance_events = 0;  ///< work on them, with what came of it
  std::vector<std::string> held;       ///< loops that a worker is analysing
  bool deleted = false;
};

/// Deletes loops with everything of theirs, in one transaction: analyses, annotations, work, their
/// places in oscillations that loops share (an oscillation whose source is deleted, or with fewer
/// than two loops left, goes as a whole). Nothing is deleted while a worker holds one of them, or,
/// without `with_results`, while one has analyses, annotations or work. Names that do not exist are
/// left out. Throws DatabaseError.
[[nodiscard]] LoopsDeletion delete_loops(const ConnectionSettings& settings,
                                         std::span<const std::string> names, bool with_results);

}  // namespace loopscope::storage
