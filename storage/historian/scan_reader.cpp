#include "storage/historian/scan_reader.hpp"

#include <algorithm>
#include <iterator>

#include "storage/historian/native_time.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/scan.hpp"
#include "storage/historian/scan_statements.hpp"
#include "storage/timestamp.hpp"

namespace loopscope::storage {
namespace {

/// The span of a batch of scans, and what lies before it.
std::pair<std::int64_t, std::int64_t> reach_of(const std::vector<Scan>& batch) {
  std::int64_t from = kLatestTimeUs;
  std::int64_t to = kEarliestTimeUs;
  for (const Scan& scan : batch) {
    from = std::min(from, clamp_time(scan.from_us) - (wants_before(scan) ? kReachBefore_us : 0));
    to = std::max(to, scan.to_us);
  }
  return {from, to};
}

}  // namespace

void ScanReader::read(const std::vector<Scan>& batch, const TablesOf& tables_of, Parts& parts) {
  if (layout_.foreign) {
    read_elsewhere(batch, tables_of, parts);
    return;
  }
  std::vector<Scan> rest;
  for (std::vector<Scan>& alike : by_span(batch)) {
    const bool fits = HeapOrder::fits(alike, layout_);
    const auto [from, to] = reach_of(alike);
    if (fits && read_in_heap_order(alike, tables_of(from, to), parts)) continue;
    std::ranges::move(alike, std::back_inserter(rest));
  }
  if (rest.empty()) return;
  const auto [from, to] = reach_of(rest);
  read_by_index(rest, tables_of(from, to), parts);
}

void ScanReader::read_elsewhere(const std::vector<Scan>& batch, const TablesOf& tables_of,
                                Parts& parts) {
  for (const Scan& scan : batch) {
    const auto [from, to] = reach_of({scan});
    read_by_index({scan}, tables_of(from, to), parts);
  }
}

void ScanReader::read_by_index(const std::vector<Scan>& batch,
                               const std::vector<std::string>& tables, Parts& parts) {
  if (tables.empty()) return;
  const Statement statement = historian_statements::read_scans(layout_, tables, columns_of(batch));
  // The rows of a batch are ten megabytes.
  run_decoded_by_row(
      connection_, statement, scan_parameters(batch, layout_),
      [&](const PqRows& row) { take_rows(row, batch, RowOrder::newest_first, parts); });
}

bool ScanReader::read_in_heap_order(const std::vector<Scan>& batch,
                                    const std::vector<std::string>& tables, Parts& parts) {
  if (tables.empty()) return true;
  const auto [plan, read] =
      historian_statements::read_in_heap_order(layout_, tables, columns_of(batch));
  const std::vector<std::string> parameters = heap_order_parameters(batch, layout_);
  if (!heap_order_.is_better(connection_, plan, batch, parameters)) return false;
  bool fit = false;
  run_decoded(connection_, read, parameters, [&](const PqRows& rows) {
    fit = all_fit(rows, batch);
    if (fit) take_rows(rows, batch, RowOrder::any, parts);
  });
  if (!fit) heap_order_.give_up(plan);
  return fit;
}

bool ScanReader::all_fit(const PqRows& rows, const std::vector<Scan>& batch) const {
  for (int row = 0; row < rows.size(); ++row) {
    const Scan& scan = batch[slot_of(rows, row, batch.size())];
    if (static_cast<std::int64_t>(rows_of_span(rows, row, layout_)) > scan.max_rows) return false;
  }
  return true;
}

void ScanReader::take_rows(const PqRows& rows, const std::vector<Scan>& batch, RowOrder order,
                           Parts& parts) const {
  const std::vector<ScanColumn> asked = columns_of(batch);
  for (int row = 0; row < rows.size(); ++row) {
    const Scan& scan = batch[slot_of(rows, row, batch.size())];
    for (std::size_t column = 0; column < scan.columns.size(); ++column) {
      const core::signal::RawSeries series =
          read_column(rows, row, scan, column, asked, layout_, order);
      for (const ScanTarget& target : scan.columns[column].targets) {
        parts[target.request][target.place] = series;
      }
    }
  }
}

}  // namespace loopscope::storage
