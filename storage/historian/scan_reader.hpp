#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/signal/raw_series.hpp"
#include "storage/historian/heap_order.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/resolve_layout.hpp"
#include "storage/historian/scan.hpp"
#include "storage/historian/scan_rows.hpp"

namespace loopscope::storage {

/// Reads batches of scans, by the index of the keys or in the order of the table (heap_order.hpp):
/// the rows are the same. Those of another
/// server (foreign tables) by its index.
class ScanReader {
 public:
  /// By request and place (ScanTarget).
  using Parts = std::vector<std::vector<core::signal::RawSeries>>;
  /// The relations that hold the rows between two times; none where there are no such rows.
  using TablesOf =
      std::function<std::vector<std::string>(std::int64_t from_us, std::int64_t to_us)>;

  /// Both have to outlive this; the layout may be another one at each read.
  ScanReader(PqConnection& connection, const ResolvedLayout& layout)
      : connection_(connection), layout_(layout) {}

  /// Fills `parts`, which has a place for each target of the batch; those without rows stay as they
  /// are. Throws DatabaseError.
  void read(const std::vector<Scan>& batch, const TablesOf& tables_of, Parts& parts);

 private:
  /// Of a foreign table: a statement for each scan.
  void read_elsewhere(const std::vector<Scan>& batch, const TablesOf& tables_of, Parts& parts);
  void read_by_index(const std::vector<Scan>& batch, const std::vector<std::string>& tables,
                     Parts& parts);
  /// False, and nothing is read, where one index scan a key is better.
  [[nodiscard]] bool read_in_heap_order(const std::vector<Scan>& batch,
                                        const std::vector<std::string>& tables, Parts& parts);
  [[nodiscard]] bool all_fit(const PqRows& rows, const std::vector<Scan>& batch) const;
  void take_rows(const PqRows& rows, const std::vector<Scan>& batch, RowOrder order,
                 Parts& parts) const;

  PqConnection& connection_;
  const ResolvedLayout& layout_;
  HeapOrder heap_order_;
};

}  // namespace loopscope::storage
