#pragma once

#include <optional>
#include <string>
#include <vector>

#include "daemon/setup/layout_candidate.hpp"

namespace loopscope::daemon {

enum class ColumnRole { time, tag, value, quality, mode };

enum class ColumnKind { time, real, whole, truth, text, uuid, other };

[[nodiscard]] ColumnKind kind_of(const storage::SeenColumn& column);

/// How well a column's name stands for a role: 0 = best, nullopt = not at all. Case, blanks and
/// punctuation do not count.
[[nodiscard]] std::optional<std::size_t> rank_of(ColumnRole role, const std::string& column);

/// Which column is what.
struct ColumnRoles {
  std::optional<storage::SeenColumn> time, tag, value, quality;
  std::vector<std::string> numbers;        ///< values of a row, if it has several
  std::vector<std::string> possible_tags;  ///< more than one, where none is the likeliest
};

/// By names and types, as far as `wishes` leave it open. Throws Failure (usage) for a wish that is
/// no column.
[[nodiscard]] ColumnRoles find_roles(const storage::SeenTable& table, const LayoutWishes& wishes);

/// The text column that is likeliest to hold names of tags, loops or devices.
[[nodiscard]] std::optional<storage::SeenColumn> find_name_column(const storage::SeenTable& table);

}  // namespace loopscope::daemon
