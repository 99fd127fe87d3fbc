#include "daemon/catalogue/read_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "core/signal/microseconds.hpp"

namespace loopscope::daemon {
namespace {

constexpr std::int64_t kDay_us = 86'400'000'000;
constexpr std::array kBack_us{std::int64_t{0}, kDay_us, 7 * kDay_us, 30 * kDay_us};
constexpr std::int64_t kRowsRead = 512;
/// Loops at a time: their values stay small beside the program.
constexpr std::size_t kBatch = 200;

using core::signal::Samples;

void add_values(const core::signal::RawSeries& rows, Samples& values) {
  for (const double value : rows.value) {
    if (std::isfinite(value)) values.push_back(value);
  }
}

std::vector<Samples> values_of(storage::HistorianReader& historian,
                               const std::vector<std::string>& tags) {
  const auto newest = historian.newest(tags, historian.now_us());
  std::vector<storage::TagRequest> requests;
  std::vector<std::size_t> owner;
  for (std::size_t k = 0; k < tags.size(); ++k) {
    if (!newest[k]) continue;
    for (const std::int64_t back_us : kBack_us) {
      const std::int64_t to_us = *newest[k] - back_us;
      requests.push_back({tags[k], to_us - kDay_us, to_us, kRowsRead});
      owner.push_back(k);
    }
  }
  std::vector<Samples> values(tags.size());
  const auto series = historian.read(requests);
  for (std::size_t k = 0; k < series.size(); ++k) add_values(series[k], values[owner[k]]);
  return values;
}

}  // namespace

std::vector<LoopValues> read_values(storage::HistorianReader& historian,
                                    std::span<const storage::CatalogueEntry> loops) {
  std::vector<LoopValues> result;
  for (std::size_t first = 0; first < loops.size(); first += kBatch) {
    const auto batch = loops.subspan(first, std::min(kBatch, loops.size() - first));
    std::vector<std::string> tags;
    for (const storage::CatalogueEntry& loop : batch) {
      tags.push_back(loop.pv_tag);
      if (!loop.op_tag.empty()) tags.push_back(loop.op_tag);
    }
    std::vector<Samples> values = values_of(historian, tags);
    std::size_t next = 0;
    for (const storage::CatalogueEntry& loop : batch) {
      LoopValues& of_loop = result.emplace_back();
      of_loop.pv = std::move(values[next++]);
      if (!loop.op_tag.empty()) of_loop.op = std::move(values[next++]);
    }
  }
  return result;
}

NewestRows newest_rows(storage::HistorianReader& historian, std::span<const std::string> tags) {
  const std::int64_t now_us = historian.now_us();
  return {historian.newest(tags, now_us), now_us};
}

std::vector<std::optional<double>> longest_gaps(storage::HistorianReader& historian,
                                                std::span<const std::string> tags) {
  constexpr std::size_t kFewest = 21;
  std::vector<std::optional<double>> gaps;
  for (std::size_t first = 0; first < tags.size(); first += kBatch) {
    const auto batch = tags.subspan(first, std::min(kBatch, tags.size() - first));
    const auto newest = historian.newest(batch, historian.now_us());
    std::vector<storage::TagRequest> requests;
    for (std::size_t k = 0; k < batch.size(); ++k) {
      const std::int64_t to_us = newest[k].value_or(0);
      requests.push_back({batch[k], to_us - kBack_us.back(), to_us, kRowsRead});
    }
    for (const core::signal::RawSeries& rows : historian.read(requests)) {
      const std::vector<std::int64_t>& times = rows.time_us;
      std::int64_t longest_us = 0;
      for (std::size_t k = 1; k < times.size(); ++k)
        longest_us = std::max(longest_us, times[k] - times[k - 1]);
      const bool enough = times.size() >= kFewest;
      gaps.push_back(enough ? std::optional(static_cast<double>(longest_us) /
                                            core::signal::kMicrosecondsPerSecond)
                            : std::nullopt);
    }
  }
  return gaps;
}

}  // namespace loopscope::daemon
