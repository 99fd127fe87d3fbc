#include "storage/historian/scan.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "storage/historian/tag_value.hpp"

namespace loopscope::storage {
namespace {

// 32 loops of three tags: larger batches read no faster and hold more memory.
constexpr std::size_t kMaxScans = 96;
// The values that a batch may ask for: 96 windows of 4096 samples with some to spare, about 20 MB.
constexpr std::int64_t kMaxValues = 786'432;
// A table has at most 1600 columns, a row of results about 1660.
constexpr std::size_t kMaxColumns = 256;

/// Key, first and last time, largest number of rows; and the column where rows that do not have it
/// must not count.
using Span =
    std::tuple<std::vector<std::string>, std::int64_t, std::int64_t, std::int64_t, std::string>;

bool wants_before(const TagRequest& request, const TagPlace& place) {
  return request.before == RowBefore::yes ||
         (request.before == RowBefore::if_held && place.hold != core::signal::Hold::sample);
}

class Planner {
 public:
  Planner(const PqConnection& connection, const ResolvedLayout& layout)
      : connection_(connection), layout_(layout) {}

  void add(const TagRequest& request, const TagPlace& place, ScanTarget target) {
    const std::string* value = value_sql(place.column);
    if (value == nullptr) return;
    const std::string alone = layout_.layout.null_is_absent ? place.column : "";
    Scan& scan =
        scan_of({place.key, request.from_us, request.to_us, request.max_rows, alone}, place);
    ScanColumn& column = column_of(scan, *value);
    column.before = column.before || wants_before(request, place);
    column.targets.push_back(target);
  }

  std::vector<std::vector<Scan>> batches() && {
    std::map<std::string, std::vector<Scan>> alike;
    for (Scan& scan : scans_) alike[signature(scan)].push_back(std::move(scan));
    std::vector<std::vector<Scan>> batches;
    for (auto& [columns, scans] : alike) cut(std::move(scans), batches);
    return batches;
  }

 private:
  const std::string* value_sql(const std::string& column) {
    auto known = values_.find(column);
    if (known == values_.end()) {
      known = values_.emplace(column, value_of(connection_, layout_, column)).first;
    }
    return known->second ? &*known->second : nullptr;
  }

  /// The scan over this span that still has room for the column.
  Scan& scan_of(const Span& span, const TagPlace& place) {
    const auto [known, first] = by_span_.try_emplace(span, scans_.size());
    const bool full = !first && scans_[known->second].columns.size() >= kMaxColumns;
    if (full) known->second = scans_.size();
    if (first || full) {
      const auto& [key, from_us, to_us, max_rows, alone] = span;
      scans_.push_back({place.key, from_us, to_us, max_rows, {}});
    }
    return scans_[known->second];
  }

  static ScanColumn& column_of(Scan& scan, const std::string& value) {
    const auto same = [&value](const ScanColumn& column) { return column.value == value; };
    const auto found = std::find_if(scan.columns.begin(), scan.columns.end(), same);
    if (found != scan.columns.end()) return *found;
    scan.columns.push_back({value, false, {}});
    return scan.columns.back();
  }

  /// Scans of one column go together, whether they want the row before or not: one pass over a
  /// table serves all of them (heap_order.hpp), and looking into an empty span costs next to
  /// nothing.
  static std::string signature(const Scan& scan) {
    if (scan.columns.size() == 1) return scan.columns.front().value;
    std::string text;
    for (const ScanColumn& column : scan.columns) {
      text += column.value + (column.before ? "\1" : "\2");
    }
    return text;
  }

  static void cut(std::vector<Scan> scans, std::vector<std::vector<Scan>>& batches) {
    std::vector<Scan> batch;
    std::int64_t values = 0;
    for (Scan& scan : scans) {
      const auto columns = static_cast<std::int64_t>(scan.columns.size());
      const std::int64_t more = std::min(scan.max_rows, kMaxValues) * columns;
      const bool full = values + more > kMaxValues || batch.size() == kMaxScans;
      if (full && !batch.empty()) {
        batches.push_back(std::exchange(batch, {}));
        values = 0;
      }
      values += more;
      batch.push_back(std::move(scan));
    }
    batches.push_back(std::move(batch));
  }

  const PqConnection& connection_;
  const ResolvedLayout& layout_;
  std::map<std::string, std::optional<std::string>> values_;  ///< by column
  std::map<Span, std::size_t> by_span_;                       ///< where scans_ has it
  std::vector<Scan> scans_;
};

}  // namespace

bool wants_before(const Scan& scan) {
  return std::ranges::any_of(scan.columns, &ScanColumn::before);
}

std::vector<ScanColumn> columns_of(const std::vector<Scan>& batch) {
  std::vector<ScanColumn> columns;
  for (const ScanColumn& column : batch.front().columns)
    columns.push_back({column.value, column.before, {}});
  for (const Scan& scan : batch) {
    for (std::size_t k = 0; k < columns.size(); ++k)
      columns[k].before = columns[k].before || scan.columns[k].before;
  }
  return columns;
}

std::vector<std::vector<Scan>> plan_scans(const PqConnection& connection,
                                          const ResolvedLayout& layout,
                                          std::span<const TagRequest> requests,
                                          std::span<const std::vector<TagPlace>> places) {
  Planner planner(connection, layout);
  for (std::size_t request = 0; request < requests.size(); ++request) {
    for (std::size_t place = 0; place < places[request].size(); ++place) {
      planner.add(requests[request], places[request][place], {request, place});
    }
  }
  return std::move(planner).batches();
}

}  // namespace loopscope::storage
