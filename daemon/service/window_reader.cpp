#include "daemon/service/window_reader.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/signal/assemble.hpp"
#include "core/signal/base_interval.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::LoopRows;
using core::signal::RawSeries;
using storage::CatalogueEntry;
using storage::ClaimedLoop;
using storage::TagRequest;

constexpr double kMicrosecondsPerSecond = 1e6;
/// Rows from which the sample interval of a loop is found that the catalogue does not state.
constexpr std::int64_t kIntervalRows = 512;
/// How far back those rows may lie: a bound keeps a dead tag from walking through every partition.
constexpr double kIntervalLookBack_s = 30.0 * 86400.0;
/// Rows per grid slot that are read at most: twice the usual rate, jitter and repeats included.
constexpr std::int64_t kRowsPerSlot = 2;

/// Everything about one loop that is known before its rows are read.
struct Plan {
  const CatalogueEntry* loop = nullptr;
  std::int64_t slot_end_us = 0;
  bool has_rows = false;
  double interval_s = 0.0;  ///< 0 = unknown
  std::size_t max_samples = 0;
};

std::int64_t microseconds(double seconds) {
  return std::llround(seconds * kMicrosecondsPerSecond);
}

std::vector<std::optional<std::int64_t>> newest_pv(storage::HistorianReader& historian,
                                                   std::span<const ClaimedLoop* const> claims) {
  std::vector<std::string> tags;
  for (const ClaimedLoop* claim : claims) tags.push_back(claim->loop.pv_tag);
  // Rows stamped in the future are a clock fault of their sender and no end of a window.
  return historian.newest(tags, historian.now_us());
}

/// `once` without any sample: the slot of the loop's registration, so that a second pass finds the
/// same one.
std::int64_t slot_end(const ClaimedLoop& claim, const std::optional<std::int64_t>& newest,
                      const WindowSettings& settings) {
  const std::int64_t end = settings.slot_rule == SlotRule::clock
                               ? claim.database_now_us - microseconds(settings.settle_s)
                               : newest.value_or(claim.loop.registered_us);
  return floor_to_period(end, claim.loop.period_s);
}

std::vector<Plan> make_plans(storage::HistorianReader& historian,
                             std::span<const ClaimedLoop* const> claims,
                             const WindowSettings& settings) {
  const auto newest = newest_pv(historian, claims);
  std::vector<Plan> plans;
  for (std::size_t k = 0; k < claims.size(); ++k) {
    const ClaimedLoop& claim = *claims[k];
    plans.push_back({&claim.loop, slot_end(claim, newest[k], settings), newest[k].has_value(),
                     claim.loop.interval_s.value_or(0.0), settings.max_samples});
  }
  return plans;
}

void find_unknown_intervals(storage::HistorianReader& historian, std::vector<Plan>& plans) {
  std::vector<Plan*> unknown;
  std::vector<TagRequest> requests;
  for (Plan& plan : plans) {
    if (!plan.has_rows || plan.interval_s > 0.0) continue;
    unknown.push_back(&plan);
    requests.push_back({plan.loop->pv_tag, plan.slot_end_us - microseconds(kIntervalLookBack_s),
                        plan.slot_end_us, kIntervalRows, false});
  }
  if (requests.empty()) return;
  const std::vector<RawSeries> rows = historian.read(requests);
  for (std::size_t k = 0; k < unknown.size(); ++k) {
    unknown[k]->interval_s = core::signal::base_interval_s(rows[k]);
  }
}

struct TagSlot {
  const std::string CatalogueEntry::*tag;
  RawSeries LoopRows::*rows;
  bool held;  ///< recorded on change: the row before the window belongs to it
};

constexpr TagSlot kTagSlots[] = {
    {&CatalogueEntry::sp_tag, &LoopRows::sp, true},
    {&CatalogueEntry::pv_tag, &LoopRows::pv, false},
    {&CatalogueEntry::op_tag, &LoopRows::op, false},
    {&CatalogueEntry::mv_tag, &LoopRows::mv, false},
    {&CatalogueEntry::mode_tag, &LoopRows::mode, true},
};

std::vector<TagRequest> requests_of(const Plan& plan) {
  std::vector<TagRequest> requests;
  const auto slots = static_cast<std::int64_t>(plan.max_samples);
  const auto span_us = microseconds(plan.interval_s * static_cast<double>(plan.max_samples));
  for (const TagSlot& slot : kTagSlots) {
    const std::string& tag = plan.loop->*slot.tag;
    if (tag.empty()) continue;
    requests.push_back(
        {tag, plan.slot_end_us - span_us, plan.slot_end_us, kRowsPerSlot * slots, slot.held});
  }
  return requests;
}

LoopRows take_rows(const CatalogueEntry& loop, std::vector<RawSeries>& series, std::size_t& next) {
  LoopRows rows;
  for (const TagSlot& slot : kTagSlots) {
    if (!(loop.*slot.tag).empty()) rows.*slot.rows = std::move(series[next++]);
  }
  return rows;
}

bool readable(const Plan& plan) {
  return plan.has_rows && plan.interval_s > 0.0;
}

core::signal::LoopWindow make_window(const Plan& plan, const LoopRows& rows) {
  const core::signal::Grid grid =
      core::signal::window_grid(rows.pv, plan.interval_s, plan.slot_end_us, plan.max_samples);
  return core::signal::assemble(rows, grid, plan.loop->op_range);
}

/// The windows of all plans in one batch of requests; an empty one for a plan without rows.
std::vector<core::signal::LoopWindow> read_plans(storage::HistorianReader& historian,
                                                 const std::vector<Plan>& plans) {
  std::vector<TagRequest> requests;
  for (const Plan& plan : plans) {
    if (!readable(plan)) continue;
    const auto more = requests_of(plan);
    requests.insert(requests.end(), more.begin(), more.end());
  }
  std::vector<RawSeries> series =
      requests.empty() ? std::vector<RawSeries>{} : historian.read(requests);
  std::vector<core::signal::LoopWindow> windows(plans.size());
  std::size_t next = 0;
  for (std::size_t k = 0; k < plans.size(); ++k) {
    if (!readable(plans[k])) continue;
    windows[k] = make_window(plans[k], take_rows(*plans[k].loop, series, next));
  }
  return windows;
}

}  // namespace

std::vector<LoopWindowAtSlot> read_windows(storage::HistorianReader& historian,
                                           std::span<const ClaimedLoop* const> claims,
                                           const WindowSettings& settings) {
  std::vector<Plan> plans = make_plans(historian, claims, settings);
  find_unknown_intervals(historian, plans);
  std::vector<core::signal::LoopWindow> windows = read_plans(historian, plans);
  std::vector<LoopWindowAtSlot> at_slots;
  for (std::size_t k = 0; k < plans.size(); ++k) {
    at_slots.push_back({plans[k].slot_end_us, std::move(windows[k])});
  }
  return at_slots;
}

std::vector<core::signal::LoopWindow> read_spans(storage::HistorianReader& historian,
                                                 std::span<const SpanRequest> requests) {
  std::vector<Plan> plans;
  for (const SpanRequest& request : requests) {
    const LoopWindowAtSlot& at_slot = *request.at_slot;
    plans.push_back({request.loop, at_slot.slot_end_us, true, at_slot.window.sample_interval_s,
                     request.samples});
  }
  return read_plans(historian, plans);
}

}  // namespace loopscope::daemon
