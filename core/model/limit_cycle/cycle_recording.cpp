#include "core/model/limit_cycle/cycle_recording.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "core/model/limit_cycle/cycle_band.hpp"
#include "core/signal/gaps.hpp"
#include "core/signal/order/spread.hpp"

namespace loopscope::core::model {
namespace {

using signal::Samples;

constexpr std::size_t kFewestForCycle = 128;
constexpr double kMostMissing = 0.4;
/// Kept samples that are judged in one go; longer records are judged in three parts.
constexpr std::size_t kLongestRecord = 1500;
constexpr std::size_t kRecordParts = 3;
constexpr std::size_t kPartLength = 600;

Samples bridged(std::span<const double> values) {
  Samples samples(values.begin(), values.end());
  signal::discard_infinite(samples);
  signal::bridge_gaps(samples, samples.size());
  const auto is_recorded = [](double v) { return !std::isnan(v); };
  const auto first = std::ranges::find_if(samples, is_recorded);
  if (first == samples.end()) return samples;
  std::fill(samples.begin(), first, *first);
  const auto last = std::find_if(samples.rbegin(), samples.rend(), is_recorded);
  std::fill(samples.rbegin(), last, *last);
  return samples;
}

bool stands_still(std::span<const double> samples) {
  const auto spread = signal::measure_spread(samples);
  return !spread || spread->constant();
}

/// Mean over the parts; -1 when op or pv stands still in all of them.
double coherence_at(const CycleRecording& recording, double period) {
  const CycleBand band(period);
  const std::vector<CycleRecord> parts = parts_of(recording, band);
  double sum = 0.0;
  for (const CycleRecord& part : parts) sum += op_coherence(part, band);
  return parts.empty() ? -1.0 : sum / static_cast<double>(parts.size());
}

}  // namespace

CycleRecording cycle_recording(std::span<const double> pv, std::span<const double> op,
                               std::span<const double> sp) {
  if (pv.size() != op.size() || (!sp.empty() && sp.size() != pv.size())) {
    throw std::invalid_argument("judge_limit_cycle: pv, op and sp of different lengths");
  }
  CycleRecording result{bridged(pv), bridged(op), {}, Samples(pv.size(), 0.0)};
  const Samples level = bridged(sp);
  const bool known = !level.empty() && std::isfinite(level.front());
  result.error = result.pv;
  for (std::size_t k = 0; k < pv.size(); ++k) {
    result.error[k] = (known ? level[k] : 0.0) - result.pv[k];
    result.recorded[k] = std::isfinite(pv[k]) && std::isfinite(op[k]) ? 1.0 : 0.0;
  }
  return result;
}

std::string unusable(const CycleRecording& recording) {
  const std::size_t samples = recording.pv.size();
  if (samples < kFewestForCycle) return "Too few samples.";
  const double recorded = signal::measure_spread(recording.recorded)->mean;
  if (recorded < 1.0 - kMostMissing) return "Too much is missing.";
  if (stands_still(recording.pv) || stands_still(recording.op)) return "pv or op stands still.";
  return "";
}

std::vector<CycleRecord> parts_of(const CycleRecording& recording, const CycleBand& band) {
  const std::size_t samples = recording.pv.size();
  const bool whole = samples / band.factor() <= kLongestRecord;
  const std::size_t parts = whole ? 1 : kRecordParts;
  const std::size_t length = whole ? samples : kPartLength * band.factor();
  std::vector<CycleRecord> result;
  for (std::size_t i = 0; i < parts; ++i) {
    const std::size_t start = parts == 1 ? 0 : i * (samples - length) / (parts - 1);
    const auto part = [&](const Samples& x) { return std::span(x).subspan(start, length); };
    const CycleRecord record{part(recording.pv), part(recording.op), part(recording.error),
                             part(recording.recorded)};
    if (!stands_still(record.pv) && !stands_still(record.op)) result.push_back(record);
  }
  return result;
}

double cycle_period(const CycleRecording& recording, const Without& without) {
  const std::vector<double> periods = candidate_periods(recording.error, recording.op);
  if (periods.size() == 1 || !without.keeps(Mechanism::second_period)) return periods.front();
  return *std::ranges::max_element(periods, {},
                                   [&](double period) { return coherence_at(recording, period); });
}

}  // namespace loopscope::core::model
