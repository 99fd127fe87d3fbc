#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/catalogue_entry.hpp"

namespace loopscope::daemon {

/// A tag of the catalogue and its newest row.
struct CheckedTag {
  std::string loop;
  std::string source;
  std::string_view role;  ///< sp, pv, op, mv or mode
  std::string tag;
  double period_s = 0.0;                  ///< of its loop
  std::optional<std::int64_t> newest_us;  ///< microseconds UTC; nullopt = the tag has no row
  double age_s = 0.0;                     ///< of that row, by the historian's clock; 0 without one
  double behind_s = 0.0;  ///< how much older it is than the newest row of all tags of its source
  std::optional<double> longest_gap_s;  ///< find_stopped(): it has stopped, and what was usual

  /// What is wrong with it; empty = nothing.
  [[nodiscard]] std::string problem() const;
};

/// Newest rows of the tags of a source, in their order, and what its clock says.
struct NewestRows {
  std::vector<std::optional<std::int64_t>> of_tags;
  std::int64_t now_us = 0;
};

/// What these throw passes through.
using AskNewest =
    std::function<NewestRows(const std::string& source, std::span<const std::string> tags)>;
/// Longest time between two rows of each tag, as far as can be said (longest_gaps).
using AskGaps = std::function<std::vector<std::optional<double>>(
    const std::string& source, std::span<const std::string> tags)>;

struct TagCheck {
  std::size_t loops = 0;
  std::vector<CheckedTag> tags;  ///< in the order of the loops and of sp, pv, op, mv, mode

  [[nodiscard]] std::size_t without_rows() const;
  [[nodiscard]] std::size_t stopped() const;
};

/// Asks every source once for all tags of its loops, and for each tag once however many loops have
/// it.
[[nodiscard]] TagCheck check_tags(std::span<const storage::CatalogueEntry> entries,
                                  const AskNewest& ask);

/// Finds the tags that have stopped: while other tags of the source went on, no row came for longer
/// than the period of the loop and than twice the longest time that ever passed between two rows of
/// the tag. So a setpoint that changes once a week has not stopped after three days, and of one
/// that hardly ever changes nothing can be said. Only tags that are behind are asked for.
void find_stopped(TagCheck& check, const AskGaps& ask);

/// Takes tags without a row out of the entries, but for pv, without which there is no loop: a table
/// with a column for the mode offers one to every loop, whether it is written or not.
void drop_dead_ends(const TagCheck& check, std::span<storage::CatalogueEntry> entries);

/// "12 s", "3.2 h", and from two days on whole days.
[[nodiscard]] std::string age_text(double age_s);

/// Every tag as CSV: loop, source, role, tag, newest_row (ISO 8601 UTC), age_s, problem.
[[nodiscard]] std::string checked_tags_csv(const TagCheck& check);

}  // namespace loopscope::daemon
