#pragma once

#include <cstdint>
#include <vector>

#include "core/signal/raw_series.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/resolve_layout.hpp"
#include "storage/historian/scan.hpp"

namespace loopscope::storage {

/// Lower bound of the row before a scan, in the column's own type; that of the span where it is not
/// wanted.
[[nodiscard]] std::string bound_before(const Scan& scan, const ResolvedLayout& layout);

/// Parameters of the statement read_scans() for a batch: one array per part of the key, then lower
/// bounds, upper bounds, largest numbers of rows, lower bounds of the row before. Where the rows
/// are on another server, of the first scan alone: the parts of its key, largest number of rows,
/// then the lower and the upper bound and those of the growing spans before it.
[[nodiscard]] std::vector<std::string> scan_parameters(const std::vector<Scan>& batch,
                                                       const ResolvedLayout& layout);

/// In which order an answer's arrays have their rows.
enum class RowOrder { newest_first, any };

/// How many rows of its table a row of the answer was put together of. Throws MalformedArray.
[[nodiscard]] std::size_t rows_of_span(const PqRows& rows, int row, const ResolvedLayout& layout);

/// The rows of one column of a scan out of a row of the answer to a statement that read the columns
/// `asked` (columns_of): ascending in time, microseconds UTC, bad values as NaN, nothing outside
/// the span but the one row before it. Rows with the same time and nothing to tell them apart come
/// in the order of their values, so that the same rows always make the same series. Throws
/// MalformedArray.
[[nodiscard]] core::signal::RawSeries read_column(const PqRows& rows, int row, const Scan& scan,
                                                  std::size_t column,
                                                  const std::vector<ScanColumn>& asked,
                                                  const ResolvedLayout& layout, RowOrder order);

/// Position, from 0, in the batch of `slots` scans that a row of the answer belongs to. Throws
/// MalformedArray.
[[nodiscard]] std::size_t slot_of(const PqRows& rows, int row, std::size_t slots);

}  // namespace loopscope::storage
