#include "tests/plants/standing_list.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

namespace loopscope::tests::plants {
namespace {

constexpr double kSure = 0.8;
/// Least share of a window with op at its limit to be excused. A choice: an engineer calls a loop
/// saturated that is at its limit for a tenth of the time; the program says it from 5 % on.
constexpr double kSaturated = 0.1;

/// Of one loop over the slots.
struct Stays {
  std::vector<std::size_t> before;     ///< slots of entries before the fault; of a healthy loop all
  std::vector<std::size_t> saturated;  ///< likewise, but op was at its limit and is said to be
  std::size_t entries = 0;
  std::optional<std::size_t> first_slot;
  bool stood_before = false;  ///< it was on the list when its fault began
  bool excused = false;       ///< it is on the list since the last of `saturated`
};

/// The first slot whose window holds a sample of the fault.
std::size_t onset_slot(const WatchedLoop& loop, const Watch& watch) {
  return loop.from_the_start ? 0 : watch.onset_windows * kSlotsInWindow + 1;
}

/// From the first sample of the fault to the end of the slot's window, windows.
double delay_of(const WatchedLoop& loop, std::size_t slot, const Watch& watch) {
  const std::size_t begin = loop.from_the_start ? 0 : (1 + watch.onset_windows) * kSlotsInWindow;
  return static_cast<double>(slot + kSlotsInWindow - begin) / kSlotsInWindow;
}

/// Whether the verdict is that op is at its limit, and op is there in one of the last `windows`
/// windows, which end a slot apart.
bool says_saturated(const WatchedLoop& loop, std::size_t slot, std::size_t windows) {
  const std::size_t first = slot + 1 - std::min(slot + 1, windows);
  const auto shares = std::span(loop.at_limit).subspan(first, slot + 1 - first);
  return loop.slots[slot].verdict == "valve_saturation" && std::ranges::max(shares) >= kSaturated;
}

/// A slot on the list without a fault. To enter, op has to be at its limit now; to let go, the list
/// may take as many slots as share samples with a window in which it was.
void count_wrong(Stays& stays, bool enters, const WatchedLoop& loop, std::size_t slot) {
  const bool excused = says_saturated(loop, slot, enters ? 1 : kSlotsInWindow);
  if (!enters && (!stays.excused || excused)) return;
  if (!enters) stays.saturated.pop_back();
  (excused ? stays.saturated : stays.before).push_back(slot);
  stays.excused = excused;
}

/// A slot on the list with the fault.
void count_right(Stays& stays, bool enters, std::size_t slot) {
  const bool stood_before = !enters && stays.entries == 0;
  if (!enters && !stood_before) return;
  ++stays.entries;
  stays.stood_before |= stood_before;
  if (!stays.first_slot) stays.first_slot = slot;
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
      if (plant[k].is_faulty() && slot >= onset_slot(watched[k], watch))
        count_right(stays[k], !on_list[k], slot);
      else
        count_wrong(stays[k], !on_list[k], watched[k], slot);
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

/// "..., listed after 0.9 windows, entries 1, a single window's 0.95".
std::string told_fault(const PlantLoop& loop, const WatchedLoop& watched, const Stays& stays,
                       const Watch& watch) {
  const std::string after =
      stays.stood_before
          ? "on the list before its fault"
          : fmt::format("listed after {:.1f} windows", delay_of(watched, *stays.first_slot, watch));
  return fmt::format("{}, {}, entries {}, a single window's {:.2f}",
                     told(loop, watched, *stays.first_slot), after, stays.entries,
                     watched.single_probability.value_or(-1.0));
}

/// Of waits of which those that never ended are infinite; nullopt = it is one of them.
std::optional<double> quantile(std::vector<double> waits, double share) {
  if (waits.empty()) return std::nullopt;
  std::ranges::sort(waits);
  const long place = std::lround(share * static_cast<double>(waits.size() - 1));
  const double value = waits[static_cast<std::size_t>(place)];
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// What is counted over all loops.
struct Sums {
  std::size_t entries = 0;
  double calm_windows = 0.0;
  std::vector<double> waits;  ///< windows, of sure faults
};

void add_fault(StandingList& list, Sums& sums, const PlantLoop& loop, const WatchedLoop& watched,
               const Stays& stays, const Watch& watch) {
  const bool sure = watched.single_probability.value_or(0.0) >= kSure;
  ++list.faults;
  if (sure) ++list.sure_faults;
  if (!stays.first_slot) {
    list.missed.push_back(told(loop, watched, watched.slots.size() - 1));
    if (sure) sums.waits.push_back(std::numeric_limits<double>::infinity());
    return;
  }
  ++list.listed;
  if (watched.slots[*stays.first_slot].verdict != loop.fault) ++list.listed_as_another;
  list.right.push_back(told_fault(loop, watched, stays, watch));
  sums.entries += stays.entries;
  if (sure) ++list.sure_listed;
  if (sure && !stays.stood_before)
    sums.waits.push_back(delay_of(watched, *stays.first_slot, watch));
}

}  // namespace

StandingList run_list(const std::vector<PlantLoop>& plant, const std::vector<WatchedLoop>& watched,
                      const Watch& watch, const FlagRule& rule) {
  const std::vector<Stays> stays = stays_of(plant, watched, watch, rule);
  StandingList list;
  Sums sums;
  for (std::size_t k = 0; k < plant.size(); ++k) {
    const bool faulty = plant[k].is_faulty();
    for (const std::size_t slot : stays[k].before)
      list.wrong.push_back(told(plant[k], watched[k], slot));
    for (const std::size_t slot : stays[k].saturated)
      list.saturated.push_back(told(plant[k], watched[k], slot));
    if (!watched[k].from_the_start)
      sums.calm_windows += static_cast<double>(faulty ? watch.onset_windows : watch.windows) + 1.0;
    if (faulty) add_fault(list, sums, plant[k], watched[k], stays[k], watch);
  }
  if (list.listed > 0)
    list.entries_per_fault = static_cast<double>(sums.entries) / static_cast<double>(list.listed);
  const auto rate = [&](std::size_t count) {
    return sums.calm_windows > 0.0 ? 1000.0 * static_cast<double>(count) / sums.calm_windows : 0.0;
  };
  list.false_entries = rate(list.wrong.size());
  list.false_entries_with_saturated = rate(list.wrong.size() + list.saturated.size());
  list.delay_windows = quantile(sums.waits, 0.5);
  list.delay_windows_p90 = quantile(sums.waits, 0.9);
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
      {"listed_as_another", list.listed_as_another},
      {"wrong", list.wrong},
      {"saturated", list.saturated},
      {"missed", list.missed},
      {"right", list.right},
  };
  return object.dump(2) + "\n";
}

}  // namespace loopscope::tests::plants
