#include "daemon/plant/plant_series.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <map>
#include <new>
#include <string>
#include <utility>

#include "core/plant/longer_record.hpp"
#include "core/signal/microseconds.hpp"
#include "core/signal/prepare.hpp"
#include "daemon/service/historians/source_gate.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/service/windows/loop_slot.hpp"
#include "daemon/service/windows/row_memory.hpp"
#include "daemon/service/windows/window_reader.hpp"

namespace loopscope::daemon {
namespace {

using Candidates = std::span<const storage::PlantCandidate>;
using Numbers = std::vector<std::size_t>;  ///< of what is wanted

/// Which of the wanted ones each historian has.
std::map<std::string, Numbers> by_source(Candidates candidates,
                                         std::span<const std::size_t> wanted) {
  std::map<std::string, Numbers> sources;
  for (std::size_t k = 0; k < wanted.size(); ++k)
    sources[candidates[wanted[k]].loop.source].push_back(k);
  return sources;
}

bool moves(const core::signal::Samples& sp) {
  for (std::size_t k = 1; k < sp.size(); ++k)
    if (sp[k] != sp[k - 1]) return true;
  return false;
}

core::signal::Samples thinned(core::signal::Samples samples, std::size_t of) {
  return of > 1 ? core::plant::means_of(samples, of) : samples;
}

/// Making it ready may have cut the beginning of a longer window off.
std::int64_t start_of(const core::signal::LoopWindow& window, std::size_t samples) {
  const auto cut = static_cast<double>(window.size() - samples);
  return window.start_us + core::signal::microseconds(cut * window.sample_interval_s);
}

PlantSeries series_of(const core::signal::LoopWindow& window, SeriesWanted how,
                      const core::signal::PrepareSettings& settings) {
  if (window.size() == 0) return {};
  core::signal::PreparedLoop loop = core::signal::prepare(window, settings);
  PlantSeries series;
  series.start_us = core::plant::start_of_means(start_of(window, loop.error.size()),
                                                loop.error.size(), how.of, loop.sample_interval_s);
  series.sample_interval_s = loop.sample_interval_s * static_cast<double>(how.of);
  series.about = core::plant::error_about(loop);
  series.error = thinned(std::move(loop.error), how.of);
  if (how.error_only) return series;
  if (moves(loop.sp)) series.sp = thinned(std::move(loop.sp), how.of);
  series.pv = thinned(std::move(loop.pv), how.of);
  series.op = thinned(std::move(loop.op_percent), how.of);
  return series;
}

struct LoopBatch {
  Candidates candidates;
  std::span<const std::size_t> wanted;
  std::span<const std::size_t> numbers;
  SeriesWanted how;
};

/// The rows that this process has read for the loop's slot, or for a later one, are not read again.
void know_kept(const storage::PlantCandidate& candidate, const config::Settings& settings,
               const WindowCache& windows, RowMemory& memory) {
  const auto window = windows.find(candidate.loop.loop_id);
  if (!window || window->slot_end_us < candidate.slot_end_us ||
      !window->is_of(candidate.loop, settings))
    return;
  try {
    for (const KeptTag& tag : window->tags) memory.know(tag.tag, tag.mode, known(tag));
  } catch (const std::bad_alloc&) {
    // They are read.
  }
}

void read_batch(storage::HistorianReader& historian, const LoopBatch& batch,
                const config::Settings& settings, SharedServices& tools, const TakeSeries& take) {
  std::vector<LoopSlot> slots;
  RowMemory memory;
  for (const std::size_t k : batch.numbers) {
    const storage::PlantCandidate& candidate = batch.candidates[batch.wanted[k]];
    const bool newest = batch.how.ends_us.empty();
    slots.push_back(
        past_slot(candidate.loop, newest ? candidate.slot_end_us : batch.how.ends_us[k]));
    if (newest) know_kept(candidate, settings, tools.windows, memory);
  }
  core::signal::PrepareSettings prepare = settings.analysis.prepare;
  prepare.window_samples *= batch.how.windows;
  const auto windows = read_windows(historian, slots, prepare.window_samples, memory);
  const CoreGate::Permit core(tools.cores);
  for (std::size_t i = 0; i < windows.size(); ++i)
    take(batch.numbers[i], series_of(windows[i].window, batch.how, prepare));
}

}  // namespace

bool read_plant_series(Candidates candidates, std::span<const std::size_t> wanted, SeriesWanted how,
                       const config::Settings& settings, SharedServices& tools,
                       const TakeSeries& take) {
  // The longer the windows, the fewer at a time: what a batch holds stays the same.
  const auto most = std::max<std::size_t>(
      1, static_cast<std::size_t>(settings.schedule.batch_loops) / how.windows);
  const auto sources = by_source(candidates, wanted);
  // Before anything is read: one that the settings lack ends the round.
  for (const auto& [source, numbers] : sources) static_cast<void>(find_historian(settings, source));
  for (const auto& [source, numbers] : sources) {
    const config::HistorianSettings& historian = find_historian(settings, source);
    for (std::size_t done = 0; done < numbers.size(); done += most) {
      if (tools.stop.stop_requested()) return false;
      const auto part = std::span(numbers).subspan(done, std::min(most, numbers.size() - done));
      tools.historians.with_reader(
          historian, source_terms(settings.schedule), [&](storage::HistorianReader& reader) {
            read_batch(reader, {candidates, wanted, part, how}, settings, tools, take);
            return true;
          });
    }
  }
  return !tools.stop.stop_requested();
}

}  // namespace loopscope::daemon
