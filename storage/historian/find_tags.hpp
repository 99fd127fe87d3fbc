#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/signal/raw_series.hpp"
#include "storage/historian/resolve_layout.hpp"

namespace loopscope::storage {

/// Where the rows of a tag, or of one of its ids, stand.
struct TagPlace {
  std::vector<std::string> key;  ///< one native text per part of the key
  std::string column;            ///< of the value; empty in narrow tables
  core::signal::Hold hold = core::signal::Hold::sample;

  bool operator==(const TagPlace&) const = default;
};

/// The places of each tag, in the order of `tags`: none for an unknown one, several in the order in
/// which its ids were made. Asks the side tables once for all tags. Throws DatabaseError.
[[nodiscard]] std::vector<std::vector<TagPlace>> find_tags(PqConnection& connection,
                                                           const ResolvedLayout& layout,
                                                           std::span<const std::string> tags);

}  // namespace loopscope::storage
