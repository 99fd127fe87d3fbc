#include "daemon/plant/compared_loops.hpp"

#include <algorithm>
#include <functional>
#include <spdlog/spdlog.h>
#include <utility>

#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "core/plant/longer_record.hpp"
#include "daemon/text/printable.hpp"
#include "storage/error.hpp"

namespace loopscope::daemon {
namespace {

using core::plant::ErrorAbout;
using core::plant::LoopRecords;
using core::plant::MemberLoop;
using core::plant::PackedError;

/// A longer span is so many windows: of loops of one second nine hours, 28 of the 20 minute cycles
/// that level loops have.
constexpr std::size_t kLongerWindows = 8;
/// Loops of which it is read at most, those with the most slow power first: so many rows a loop
/// have to leave the historian time for others.
constexpr std::size_t kMostLonger = 500;
/// Of the variance, below which a slow swing hardly touches the loop.
constexpr double kLeastSlower = 0.1;
/// Who foretells whom takes thirteen periods (core/plant/lead): below twice the fewest that can be
/// followed at all the longer record is better.
constexpr double kFewForForecasts = 2.0;

MemberLoop loop_of(const storage::PlantCandidate& candidate) {
  MemberLoop loop;
  loop.id = candidate.loop.loop_id;
  loop.name = candidate.loop.name;
  loop.own = core::diagnosis::own_findings(candidate.verdict);
  return loop;
}

/// The slowest loops, those with the most power that their windows are too short for.
std::vector<std::size_t> slow_ones(std::span<const LoopRecords> loops) {
  std::vector<std::pair<double, std::size_t>> slow;
  for (std::size_t k = 0; k < loops.size(); ++k)
    if (const double share = loops[k].slower_share(); share >= kLeastSlower)
      slow.emplace_back(share, k);
  std::ranges::stable_sort(slow, std::ranges::greater(), &std::pair<double, std::size_t>::first);
  if (slow.size() > kMostLonger) slow.resize(kMostLonger);
  std::vector<std::size_t> numbers;
  for (const auto& [share, number] : slow) numbers.push_back(number);
  return numbers;
}

/// Whether an error from earlier rows goes on as the record's: about a setpoint, not about a mean
/// of its own, and at an interval that is not found anew.
bool goes_on(const storage::PlantCandidate& candidate, const PackedError& record) {
  return record.about() == ErrorAbout::setpoint &&
         candidate.loop.interval_s == std::optional(record.sample_interval_s());
}

/// Old rows may be out of reach where new ones are not: the round goes on without them.
template <typename Read>
bool unless_out_of_reach(Read read) {
  try {
    return read();
  } catch (const storage::DatabaseError& error) {
    spdlog::warn("plant round: slow swings are not compared, {} HINT: {}", printable(error.what()),
                 printable(error.hint()));
    return true;
  }
}

PackedError packed(const PlantSeries& series) {
  return {series.error, series.sample_interval_s, series.start_us, series.about};
}

/// Of a loop whose rows have gone since.
PlantSeries error_of(const PackedError& error) {
  PlantSeries series;
  series.sample_interval_s = error.sample_interval_s();
  series.start_us = error.start_us();
  series.error = error.unpacked();
  series.about = error.about();
  return series;
}

}  // namespace

ComparedLoops::ComparedLoops(std::vector<storage::PlantCandidate> candidates,
                             const config::Settings& settings, SharedServices& tools)
    : candidates_(std::move(candidates)), settings_(settings), tools_(tools) {
  loops_.reserve(candidates_.size());
  for (storage::PlantCandidate& candidate : candidates_) {
    loops_.push_back(loop_of(candidate));
    candidate.verdict = {};  // a kilobyte
  }
  records_.resize(loops_.size(), LoopRecords(PackedError()));
  series_.resize(loops_.size());
}

void ComparedLoops::show(std::size_t loop, PlantSeries series) {
  PlantSeries& kept = series_[loop] = std::move(series);
  MemberLoop& shown = loops_[loop];
  shown.sample_interval_s = kept.sample_interval_s;
  shown.start_us = kept.start_us;
  shown.error = kept.error;
  shown.sp = kept.sp;
  shown.pv = kept.pv;
  shown.op = kept.op;
}

bool ComparedLoops::read_errors() {
  std::vector<std::size_t> others;
  {
    const CoreGate::Permit core(tools_.cores);
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      const storage::PlantCandidate& candidate = candidates_[k];
      if (auto kept = tools_.errors.take(candidate.loop.loop_id, candidate.slot_end_us))
        records_[k] = LoopRecords(std::move(*kept));
      else
        others.push_back(k);
    }
  }
  const bool done = read_plant_series(candidates_, others, {}, settings_, tools_,
                                      [&](std::size_t k, const PlantSeries& series) {
                                        records_[others[k]] = LoopRecords(packed(series));
                                      });
  count_read();
  return done;
}

bool ComparedLoops::read_longer() {
  std::vector<std::size_t> slow;
  {
    const CoreGate::Permit core(tools_.cores);
    slow = slow_ones(records_);
  }
  const auto others = std::stable_partition(slow.begin(), slow.end(), [&](std::size_t loop) {
    return goes_on(candidates_[loop], records_[loop].error());
  });
  const auto going_on = static_cast<std::size_t>(others - slow.begin());
  const std::span all(slow);
  return unless_out_of_reach([&] { return read_earlier(all.first(going_on)); }) &&
         unless_out_of_reach([&] { return read_longer(all.subspan(going_on)); });
}

bool ComparedLoops::read_longer(std::span<const std::size_t> slow) {
  return read_plant_series(candidates_, slow, {.windows = kLongerWindows, .of = kLongerWindows},
                           settings_, tools_, [&](std::size_t k, const PlantSeries& series) {
                             if (series.error.empty()) return;
                             records_[slow[k]].add_longer(packed(series));
                           });
}

bool ComparedLoops::read_earlier(std::span<const std::size_t> slow) {
  std::vector<std::int64_t> ends_us;
  for (const std::size_t loop : slow)
    ends_us.push_back(core::plant::end_of_earlier(records_[loop].error(), kLongerWindows));
  return read_plant_series(
      candidates_, slow, {.windows = kLongerWindows - 1, .of = kLongerWindows, .ends_us = ends_us},
      settings_, tools_, [&](std::size_t k, const PlantSeries& series) {
        if (series.error.empty() || series.about != ErrorAbout::setpoint) return;
        core::plant::LoopRecords& records = records_[slow[k]];
        records.add_longer(core::plant::longer_record({series.error, series.start_us},
                                                      records.error(), kLongerWindows));
      });
}

void ComparedLoops::keep_only(std::span<const core::plant::Event> events) {
  std::vector<bool> is_member(loops_.size());
  for (const core::plant::Event& event : events)
    for (const core::plant::EventMember& one : event.members) is_member[one.index] = true;
  for (std::size_t k = 0; k < loops_.size(); ++k)
    if (!is_member[k]) records_[k] = LoopRecords(PackedError());
}

bool ComparedLoops::read_members(std::span<const core::plant::Event> events) {
  std::vector<std::size_t> all, longer;
  for (const core::plant::Event& event : events)
    for (const core::plant::EventMember& one : event.members) {
      all.push_back(one.index);
      const LoopRecords& records = records_[one.index];
      if (records.has_longer() && event.frequency_hz < kFewForForecasts * records.slowest_hz())
        longer.push_back(one.index);
    }
  if (!read_members(all, 1)) return false;
  {
    const CoreGate::Permit core(tools_.cores);
    cascades_ = core::plant::find_cascade_pairs(loops_);
  }
  return read_members(longer, kLongerWindows);
}

bool ComparedLoops::read_members(std::span<const std::size_t> members, std::size_t windows) {
  return read_plant_series(candidates_, members,
                           {.windows = windows, .of = windows, .error_only = false}, settings_,
                           tools_, [&](std::size_t k, PlantSeries&& series) {
                             const std::size_t loop = members[k];
                             if (!series.error.empty())
                               show(loop, std::move(series));
                             else if (loops_[loop].error.empty())
                               show(loop, error_of(records_[loop].error()));
                           });
}

void ComparedLoops::count_read() {
  read_ = oscillating_ = 0;
  for (std::size_t k = 0; k < records_.size(); ++k) {
    if (records_[k].error().empty()) continue;
    ++read_;
    oscillating_ += candidates_[k].oscillating ? 1 : 0;
  }
}

}  // namespace loopscope::daemon
