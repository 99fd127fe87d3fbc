#include "daemon/plant/plant_series.hpp"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <map>
#include <string>
#include <utility>

#include "core/diagnosis/first_look.hpp"
#include "core/signal/microseconds.hpp"
#include "daemon/service/past_slot.hpp"
#include "daemon/service/row_memory.hpp"
#include "daemon/service/source_terms.hpp"
#include "daemon/service/storage_settings.hpp"
#include "daemon/service/window_reader.hpp"

namespace loopscope::daemon {
namespace {

using Candidates = std::span<const storage::PlantCandidate>;
using Numbers = std::vector<std::size_t>;  ///< of candidates

/// Which candidates each historian has.
std::map<std::string, Numbers> by_source(Candidates candidates) {
  std::map<std::string, Numbers> sources;
  for (std::size_t k = 0; k < candidates.size(); ++k)
    sources[candidates[k].loop.source].push_back(k);
  return sources;
}

bool moves(const core::signal::Samples& sp) {
  for (std::size_t k = 1; k < sp.size(); ++k)
    if (sp[k] != sp[k - 1]) return true;
  return false;
}

PlantSeries series_of(const core::signal::LoopWindow& window,
                      const core::AnalysisSettings& settings) {
  if (window.size() == 0) return {};
  core::signal::PreparedLoop loop = core::first_look(window, settings).loop;
  PlantSeries series{loop.sample_interval_s, window.start_us, std::move(loop.error), {}, {}, {}};
  // The analysis may have cut the beginning of a longer window off.
  const auto cut = static_cast<double>(window.size() - series.error.size());
  series.start_us += static_cast<std::int64_t>(cut * window.sample_interval_s *
                                               core::signal::kMicrosecondsPerSecond);
  if (moves(loop.sp)) series.sp = std::move(loop.sp);
  series.pv = std::move(loop.pv);
  series.op = std::move(loop.op_percent);
  return series;
}

void read_batch(storage::HistorianReader& historian, Candidates candidates,
                std::span<const std::size_t> batch, const core::AnalysisSettings& settings,
                CoreGate& cores, std::vector<PlantSeries>& series) {
  std::vector<LoopSlot> slots;
  for (const std::size_t k : batch)
    slots.push_back(past_slot(candidates[k].loop, candidates[k].slot_end_us));
  RowMemory memory;
  const auto windows = read_windows(historian, slots, settings.prepare.window_samples, memory);
  const CoreGate::Permit core(cores);
  for (std::size_t i = 0; i < batch.size(); ++i)
    series[batch[i]] = series_of(windows[i].window, settings);
}

}  // namespace

std::vector<PlantSeries> read_plant_series(Candidates candidates, const config::Settings& settings,
                                           LaneTools& tools) {
  std::vector<PlantSeries> series(candidates.size());
  const auto most = static_cast<std::size_t>(settings.schedule.batch_loops);
  const auto sources = by_source(candidates);
  // Before anything is read: one that the settings lack ends the round.
  for (const auto& [source, numbers] : sources) static_cast<void>(find_historian(settings, source));
  for (const auto& [source, numbers] : sources) {
    const config::HistorianSettings& historian = find_historian(settings, source);
    for (std::size_t done = 0; done < numbers.size(); done += most) {
      if (tools.bell.rung()) return {};
      const auto batch = std::span(numbers).subspan(done, std::min(most, numbers.size() - done));
      tools.historians.with_reader(
          historian, source_terms(settings.schedule), [&](storage::HistorianReader& reader) {
            read_batch(reader, candidates, batch, settings.analysis, tools.cores, series);
            return true;
          });
    }
  }
  return series;
}

}  // namespace loopscope::daemon
