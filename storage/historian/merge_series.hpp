#pragma once

#include <vector>

#include "core/signal/raw_series.hpp"
#include "storage/historian/tag_request.hpp"

namespace loopscope::storage {

/// The rows of a tag's several ids as one series in ascending time, at most `request.max_rows` of
/// the span; at one time the row of the later id comes last. Where a later id is being written (its
/// rows before and after are no further apart than usual), rows of an earlier one are left out: two
/// signals under one name (gateways that share a path) must not become one. Of the rows before the
/// span only the newest stays. A single part is returned as it is.
[[nodiscard]] core::signal::RawSeries merge_series(std::vector<core::signal::RawSeries> parts,
                                                   const TagRequest& request);

}  // namespace loopscope::storage
