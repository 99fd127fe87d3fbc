#include "tests/plants/standing_list.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace loopscope::tests::plants {
namespace {

constexpr double kSure = 0.8;
/// Least share of a window with op at its limit of a loop that an engineer calls saturated: the
/// least with which loops of the kind `valve_saturation` are drawn.
constexpr double kSaturated = 0.1;

/// Of one loop over the slots.
struct Stays {
  std::vector<std::size_t> before;     ///< slots of entries before the fault; of a healthy loop all
  std::vector<std::size_t> saturated;  ///< likewise, but op was at its limit and is said to be
  std::size_t entries = 0;
  std::optional<std::size_t> first_slot;
  bool excused = false;  ///< it is on the list since the last of `saturated`
};

/// Whether the verdict is that op is at its limit, and op was there in this window or in one that
/// shares samples with it: the list may take a window to let go.
bool says_saturated(const WatchedLoop& loop, std::size_t slot) {
  const auto end = loop.at_limit.begin() + static_cast<std::ptrdiff_t>(slot) + 1;
  const auto begin = end - static_cast<std::ptrdiff_t>(std::min(slot + 1, kSlotsInWindow));
  return loop.slots[slot].verdict == "valve_saturation" &&
         *std::max_element(begin, end) >= kSaturated;
}

/// A slot on the list without a fault. A stay that was excused is false from the slot on in which
/// it no longer is.
void count_wrong(Stays& stays, bool enters, bool excused, std::size_t slot) {
  if (!enters && (!stays.excused || excused)) return;
  if (!enters) stays.saturated.pop_back();
  (excused ? stays.saturated : stays.before).push_back(slot);
  stays.excused = excused;
}

/// The first slot whose window holds a sample of the fault.
std::size_t onset_slot(const WatchedLoop& loop, const Watch& watch) {
  return loop.from_the_start ? 0 : watch.onset_windows * kSlotsInWindow + 1;
}

/// From the first sample of the fault to the end of the slot's window, windows.
double delay_of(const WatchedLoop& loop, std::size_t slot, const Watch& watch) {
  const std::size_t begin = loop.from_the_start ? 0 : (1 + watch.onset_windows) * kSlotsInWindow;
  return static_cast<double>(slot + kSlotsInWindow - begin) / kSlotsInWindow;
}

std::vector<Stays> stays_of(const std::vector<PlantLoop>& plant,
                            const std::vector<WatchedLoop>& watched, const Watch& watch,
                            const FlagRule& rule) {
  std::vector<Stays> stays(plant.size());
  std::vector<bool> on_list(plant.size(), false);
  const std::size_t slots = watched.empty() ? 0 : watched.front().slots.size();
  for (std::size_t slot = 0; slot < slots; ++slot) {
    std::vector<DiagnosedLoop> now;
    for (const WatchedLoop& loop : watched) now.push_back(loop.slots[slot]);
    const std::vector<bool> listed = flagged_after(now, on_list, rule);
    for (std::size_t k = 0; k < plant.size(); ++k) {
      if (!listed[k]) continue;
      const bool stands = plant[k].is_faulty() && slot >= onset_slot(watched[k], watch);
      if (!stands) count_wrong(stays[k], !on_list[k], says_saturated(watched[k], slot), slot);
      if (!stands || on_list[k]) continue;
      ++stays[k].entries;
      if (!stays[k].first_slot) stays[k].first_slot = slot;
    }
    on_list = listed;
  }
  return stays;
}

/// "L017 (healthy_moving): valve_stiction at slot 31, fault 0.991, p 1.2e-06 of 5 tests, op at its
/// limit for 0.0 %".
std::string told(const PlantLoop& loop, const WatchedLoop& watched, std::size_t slot) {
  const DiagnosedLoop& judged = watched.slots[slot];
  return fmt::format(
      "{} ({}): {} at slot {}, fault {:.3f}, p {:.2g} of {} tests, op at its limit for {:.1f} %",
      loop.name, loop.record, judged.verdict, slot, judged.fault_probability.value_or(-1.0),
      judged.p.value_or(-1.0), judged.tests, 100.0 * watched.at_limit[slot]);
}

std::optional<double> quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nullopt;
  std::ranges::sort(values);
  const long place = std::lround(share * static_cast<double>(values.size() - 1));
  return values[static_cast<std::size_t>(place)];
}

}  // namespace

StandingList run_list(const std::vector<PlantLoop>& plant, const std::vector<WatchedLoop>& watched,
                      const Watch& watch, const FlagRule& rule) {
  const std::vector<Stays> stays = stays_of(plant, watched, watch, rule);
  StandingList list;
  std::size_t entries = 0;
  double calm_windows = 0.0;
  std::vector<double> delays;
  for (std::size_t k = 0; k < plant.size(); ++k) {
    const bool faulty = plant[k].is_faulty();
    for (const std::size_t slot : stays[k].before)
      list.wrong.push_back(told(plant[k], watched[k], slot));
    for (const std::size_t slot : stays[k].saturated)
      list.saturated.push_back(told(plant[k], watched[k], slot));
    if (!watched[k].from_the_start)
      calm_windows += static_cast<double>(faulty ? watch.onset_windows : watch.windows) + 1.0;
    if (!faulty) continue;
    const bool sure = watched[k].single_probability.value_or(0.0) >= kSure;
    ++list.faults;
    if (sure) ++list.sure_faults;
    if (!stays[k].first_slot)
      list.missed.push_back(told(plant[k], watched[k], watched[k].slots.size() - 1));
    if (!stays[k].first_slot) continue;
    ++list.listed;
    entries += stays[k].entries;
    if (!sure) continue;
    ++list.sure_listed;
    delays.push_back(delay_of(watched[k], *stays[k].first_slot, watch));
  }
  if (list.listed > 0)
    list.entries_per_fault = static_cast<double>(entries) / static_cast<double>(list.listed);
  const auto rate = [&](std::size_t count) {
    return calm_windows > 0.0 ? 1000.0 * static_cast<double>(count) / calm_windows : 0.0;
  };
  list.false_entries = rate(list.wrong.size());
  list.false_entries_with_saturated = rate(list.wrong.size() + list.saturated.size());
  list.delay_windows = quantile(delays, 0.5);
  list.delay_windows_p90 = quantile(delays, 0.9);
  return list;
}

std::string json_of(const StandingList& list) {
  const auto number = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
  };
  const nlohmann::ordered_json object = {
      {"standing_faults", list.faults},
      {"listed_faults", list.listed},
      {"entries_per_fault", list.entries_per_fault},
      {"false_entries", list.false_entries},
      {"false_entries_with_saturated", list.false_entries_with_saturated},
      {"sure_faults", list.sure_faults},
      {"sure_listed", list.sure_listed},
      {"delay_windows", number(list.delay_windows)},
      {"delay_windows_p90", number(list.delay_windows_p90)},
      {"wrong", list.wrong},
      {"saturated", list.saturated},
      {"missed", list.missed},
  };
  return object.dump(2) + "\n";
}

}  // namespace loopscope::tests::plants
