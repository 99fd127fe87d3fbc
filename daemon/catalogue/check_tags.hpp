#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/catalogue_entry.hpp"

namespace loopscope::daemon {

/// A tag of the catalogue that leads to nothing.
struct DeadEnd {
  std::string loop;
  std::string source;
  std::string_view role;  ///< sp, pv, op, mv or mode
  std::string tag;
  std::string problem;
};

/// Which of the tags of a source have a row, in their order. What it throws passes through.
using HasRows =
    std::function<std::vector<bool>(const std::string& source, std::span<const std::string> tags)>;

/// What does not resolve.
struct TagCheck {
  std::size_t loops = 0;
  std::size_t tags = 0;
  std::vector<DeadEnd> dead_ends;  ///< in the order of the loops and of sp, pv, op, mv, mode
};

/// Asks every source once for all tags of its loops, and for each tag once however many loops have
/// it.
[[nodiscard]] TagCheck check_tags(std::span<const storage::CatalogueEntry> entries,
                                  const HasRows& has_rows);

/// Takes dead ends out of the entries, but for pv, without which there is no loop: a table with a
/// column for the mode offers one to every loop, whether it is written or not.
void drop_dead_ends(const TagCheck& check, std::span<storage::CatalogueEntry> entries);

/// The dead ends as CSV: loop, source, role, tag, problem.
[[nodiscard]] std::string dead_ends_csv(const TagCheck& check);

}  // namespace loopscope::daemon
