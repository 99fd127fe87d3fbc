#include "storage/historian/heap_order.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "storage/array_literal.hpp"
#include "storage/historian/native_time.hpp"
#include "storage/historian/scan_rows.hpp"

namespace loopscope::storage {
namespace {

// Few keys share few pages, and a few rows of each are found sooner by their index.
constexpr std::size_t kFewestScans = 8;
constexpr std::int64_t kFewestRows = 256;
constexpr int kUsesOfAnAnswer = 64;
// Tables of past months leave the statements; years of them need not be remembered.
constexpr std::size_t kMostAnswers = 64;
// Of one scan, so that their sum is one too.
constexpr std::int64_t kMostRows = 1'000'000'000;

/// The number after "rows=" in a line of a plan; a plan without one expects anything.
double expected_rows(std::string_view line) {
  constexpr std::string_view kRows = "rows=";
  double rows = 1e300;
  const std::size_t at = line.find(kRows);
  if (at != std::string_view::npos)
    std::from_chars(line.data() + at + kRows.size(), line.data() + line.size(), rows);
  return rows;
}

/// Bitmaps that an index on the key makes, over no more rows than are wanted, and no other scan.
bool goes_by_bitmaps(const PqRows& plan, double rows_wanted) {
  double expected = 0.0;
  bool bitmaps = false, keys = false;
  for (int row = 0; row < plan.size(); ++row) {
    const std::string line = plan.text(row, 0);
    const auto has = [&line](const char* words) { return line.find(words) != std::string::npos; };
    // A tag may be called what it likes: only lines of nodes have a cost.
    const bool node = has("  (cost=");
    if (node && has("Bitmap Index Scan on ")) {
      bitmaps = true;
      expected += expected_rows(line);
    } else if (node && has(" Scan ") && !has("Bitmap Heap Scan on ")) {
      return false;
    }
    keys = keys || (has("Index Cond: ") && has("= ANY ("));
  }
  return bitmaps && keys && expected <= rows_wanted;
}

/// Rows that the scans of a batch want at most.
std::int64_t rows_wanted(const std::vector<Scan>& batch) {
  std::int64_t rows = 0;
  for (const Scan& scan : batch) rows += std::clamp<std::int64_t>(scan.max_rows, 0, kMostRows);
  return rows;
}

}  // namespace

std::vector<std::vector<Scan>> by_span(std::vector<Scan> scans) {
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<Scan>> groups;
  for (Scan& scan : scans) groups[{scan.from_us, scan.to_us}].push_back(std::move(scan));
  std::vector<std::vector<Scan>> result;
  result.reserve(groups.size());
  for (auto& [span, group] : groups) result.push_back(std::move(group));
  return result;
}

bool HeapOrder::fits(const std::vector<Scan>& batch, const ResolvedLayout& layout) {
  const auto many = [](const Scan& scan) { return scan.max_rows >= kFewestRows; };
  return batch.size() >= kFewestScans && std::ranges::all_of(batch, many) &&
         layout.key.size() == 1 && layout.nanos.empty() && layout.tiebreak.empty();
}

bool HeapOrder::is_better(PqConnection& connection, const Statement& plan,
                          const std::vector<Scan>& batch,
                          const std::vector<std::string>& parameters) {
  if (answers_.size() > kMostAnswers) answers_.clear();
  Answer& answer = answers_[plan.sql];
  if (answer.uses_left-- > 0) return answer.better;
  const std::vector<std::string> first(parameters.begin(), parameters.begin() + 4);
  answer = {goes_by_bitmaps(connection.run(plan, first), static_cast<double>(rows_wanted(batch))),
            kUsesOfAnAnswer};
  return answer.better;
}

void HeapOrder::give_up(const Statement& plan) {
  answers_[plan.sql] = {false, kUsesOfAnAnswer};
}

std::vector<std::string> heap_order_parameters(const std::vector<Scan>& batch,
                                               const ResolvedLayout& layout) {
  const TimeKind kind = layout.layout.time_kind;
  ArrayLiteral keys, before;
  for (const Scan& scan : batch) {
    keys.add_text(scan.key.front());
    before.add_text(bound_before(scan, layout));
  }
  return {keys.text(), native_bound(kind, batch.front().from_us, Bound::lower),
          native_bound(kind, batch.front().to_us, Bound::upper),
          std::to_string(rows_wanted(batch) + 1), before.text()};
}

}  // namespace loopscope::storage
