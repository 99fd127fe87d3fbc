#include "daemon/service/windows/window_reader.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/signal/assemble.hpp"
#include "core/signal/base_interval.hpp"
#include "core/signal/microseconds.hpp"
#include "daemon/catalogue/entry_fields.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::LoopRows;
using core::signal::RawSeries;
using storage::CatalogueEntry;
using storage::RowBefore;
using storage::TagRequest;

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
  TagReadings tags = {};
  std::optional<core::signal::PvPast> pv_past = std::nullopt;
};

std::vector<Plan> make_plans(std::span<const LoopSlot> slots, std::size_t max_samples) {
  std::vector<Plan> plans;
  for (const LoopSlot& slot : slots) {
    const TagReading* pv = find_reading(slot.tags, "pv");
    plans.push_back({slot.loop, slot.end_us, pv != nullptr && pv->newest_row_us.has_value(),
                     slot.loop->interval_s.value_or(0.0), max_samples, slot.tags, slot.pv_past});
  }
  return plans;
}

void find_unknown_intervals(storage::HistorianReader& historian, std::vector<Plan>& plans) {
  std::vector<Plan*> unknown;
  std::vector<TagRequest> requests;
  for (Plan& plan : plans) {
    if (!plan.has_rows || plan.interval_s > 0.0) continue;
    unknown.push_back(&plan);
    requests.push_back({plan.loop->pv_tag,
                        plan.slot_end_us - core::signal::microseconds(kIntervalLookBack_s),
                        plan.slot_end_us, kIntervalRows, RowBefore::no});
  }
  if (requests.empty()) return;
  const std::vector<RawSeries> rows = historian.read(requests);
  for (std::size_t k = 0; k < unknown.size(); ++k) {
    unknown[k]->interval_s = core::signal::base_interval_s(rows[k]);
  }
}

std::vector<TagRequest> requests_of(const Plan& plan) {
  std::vector<TagRequest> requests;
  const auto slots = static_cast<std::int64_t>(plan.max_samples);
  const auto span_us =
      core::signal::microseconds(plan.interval_s * static_cast<double>(plan.max_samples));
  for (const TagRole& role : kTagRoles) {
    const std::string& tag = plan.loop->*role.tag;
    if (tag.empty()) continue;
    requests.push_back({tag, plan.slot_end_us - span_us, plan.slot_end_us, kRowsPerSlot * slots,
                        role.on_change ? RowBefore::yes : RowBefore::if_held, role.is_mode()});
  }
  return requests;
}

LoopRows take_rows(const CatalogueEntry& loop, std::vector<RawSeries>& series, std::size_t& next) {
  LoopRows rows;
  for (const TagRole& role : kTagRoles) {
    if (!(loop.*role.tag).empty()) rows.*role.rows = std::move(series[next++]);
  }
  return rows;
}

/// Missing is what is of bad quality, NULL, or no number.
void count_rows(const LoopRows& rows, std::size_t max_rows, TagReadings& tags) {
  for (const TagRole& role : kTagRoles) {
    const RawSeries& series = rows.*role.rows;
    for (TagReading& reading : tags) {
      if (reading.role != role.name) continue;
      reading.rows = series.value.size();
      reading.unknown_rows = series.unknown_quality;
      reading.surplus_rows = reading.rows >= max_rows ? reading.rows : 0;
      reading.bad_rows = static_cast<std::size_t>(
          std::ranges::count_if(series.value, [](double value) { return std::isnan(value); }));
    }
  }
}

bool readable(const Plan& plan) {
  return plan.has_rows && plan.interval_s > 0.0;
}

core::signal::LoopWindow make_window(const Plan& plan, const LoopRows& rows) {
  const core::signal::Grid grid =
      core::signal::window_grid(rows.pv, plan.interval_s, plan.slot_end_us, plan.max_samples);
  core::signal::LoopWindow window = core::signal::assemble(rows, grid, plan.loop->op_range);
  window.pv_past = plan.pv_past;
  return window;
}

/// The windows of all plans in one batch of requests; an empty one for a plan without rows.
std::vector<core::signal::LoopWindow> read_plans(storage::HistorianReader& historian,
                                                 std::vector<Plan>& plans, RowMemory& memory) {
  std::vector<TagRequest> requests;
  for (const Plan& plan : plans) {
    if (!readable(plan)) continue;
    const auto more = requests_of(plan);
    requests.insert(requests.end(), more.begin(), more.end());
  }
  std::vector<RawSeries> series = memory.read(
      requests, [&](std::span<const TagRequest> missing) { return historian.read(missing); });
  std::vector<core::signal::LoopWindow> windows(plans.size());
  std::size_t next = 0;
  for (std::size_t k = 0; k < plans.size(); ++k) {
    if (!readable(plans[k])) continue;
    const LoopRows rows = take_rows(*plans[k].loop, series, next);
    count_rows(rows, static_cast<std::size_t>(kRowsPerSlot) * plans[k].max_samples, plans[k].tags);
    windows[k] = make_window(plans[k], rows);
  }
  return windows;
}

}  // namespace

std::vector<LoopWindowAtSlot> read_windows(storage::HistorianReader& historian,
                                           std::span<const LoopSlot> slots, std::size_t max_samples,
                                           RowMemory& memory) {
  std::vector<Plan> plans = make_plans(slots, max_samples);
  find_unknown_intervals(historian, plans);
  std::vector<core::signal::LoopWindow> windows = read_plans(historian, plans, memory);
  std::vector<LoopWindowAtSlot> at_slots;
  for (std::size_t k = 0; k < plans.size(); ++k) {
    at_slots.push_back({plans[k].slot_end_us, std::move(windows[k]), std::move(plans[k].tags)});
  }
  return at_slots;
}

std::vector<core::signal::LoopWindow> read_spans(storage::HistorianReader& historian,
                                                 std::span<const SpanRequest> requests,
                                                 RowMemory& memory) {
  std::vector<Plan> plans;
  for (const SpanRequest& request : requests) {
    const LoopWindowAtSlot& at_slot = *request.at_slot;
    plans.push_back({request.loop,
                     at_slot.slot_end_us,
                     true,
                     at_slot.window.sample_interval_s,
                     request.samples,
                     {}});
  }
  return read_plans(historian, plans, memory);
}

}  // namespace loopscope::daemon
