#include "core/model/limit_cycle_cause.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <vector>

#include "core/model/cycle_band.hpp"
#include "core/model/cycle_evidence.hpp"
#include "core/model/cycle_period.hpp"
#include "core/signal/gaps.hpp"
#include "core/signal/loop_window.hpp"
#include "core/signal/spread.hpp"

namespace loopscope::core::model {
namespace {

using signal::Samples;

constexpr std::size_t kFewestSamples = 128;
constexpr double kFewestCycles = 5.0;
constexpr double kMostMissing = 0.4;
/// Kept samples that are judged in one go; longer records are judged in three parts.
constexpr std::size_t kLongestRecord = 1500;
constexpr std::size_t kParts = 3;
constexpr std::size_t kPartLength = 600;

struct Recording {
  Samples pv, op, error, recorded;
};

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

Recording prepare(std::span<const double> pv, std::span<const double> op,
                  std::span<const double> sp) {
  Recording result{bridged(pv), bridged(op), {}, Samples(pv.size(), 0.0)};
  const Samples level = bridged(sp);
  const bool known = !level.empty() && std::isfinite(level.front());
  result.error = result.pv;
  for (std::size_t k = 0; k < pv.size(); ++k) {
    result.error[k] = (known ? level[k] : 0.0) - result.pv[k];
    result.recorded[k] = std::isfinite(pv[k]) && std::isfinite(op[k]) ? 1.0 : 0.0;
  }
  return result;
}

bool stands_still(std::span<const double> samples) {
  const auto spread = signal::measure_spread(samples);
  return !spread || spread->constant();
}

/// Why the recording cannot be judged; empty when it can.
std::string unusable(const Recording& recording) {
  const std::size_t samples = recording.pv.size();
  if (samples < kFewestSamples) return "Too few samples.";
  const double recorded = signal::measure_spread(recording.recorded)->mean;
  if (recorded < 1.0 - kMostMissing) return "Too much is missing.";
  if (stands_still(recording.pv) || stands_still(recording.op)) return "pv or op stands still.";
  return "";
}

/// Those in which op and pv move.
std::vector<CycleRecord> parts_of(const Recording& recording, const CycleBand& band) {
  const std::size_t samples = recording.pv.size();
  const bool whole = samples / band.factor() <= kLongestRecord;
  const std::size_t parts = whole ? 1 : kParts;
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

/// Means of what the score reads; the process is that of the part whose law fits best.
CycleEvidence combine(const std::vector<CycleEvidence>& parts) {
  CycleEvidence result = *std::ranges::min_element(parts, {}, &CycleEvidence::error_law);
  constexpr std::array kMeans = {
      &CycleEvidence::error_before, &CycleEvidence::error_law,   &CycleEvidence::error_turning,
      &CycleEvidence::part_ratio,   &CycleEvidence::steadiness,  &CycleEvidence::band_share,
      &CycleEvidence::op_coherence, &CycleEvidence::op_triangle, &CycleEvidence::pv_third,
      &CycleEvidence::pv_triangle,  &CycleEvidence::travel};
  for (const auto member : kMeans) {
    double sum = 0.0;
    for (const CycleEvidence& part : parts) sum += part.*member;
    result.*member = sum / static_cast<double>(parts.size());
  }
  return result;
}

/// nullopt when op or pv stands still in every part.
std::optional<CycleEvidence> gather(const Recording& recording, double period) {
  const CycleBand band(period);
  std::vector<CycleEvidence> parts;
  for (const CycleRecord& part : parts_of(recording, band))
    parts.push_back(gather_cycle_evidence(part, band));
  if (parts.empty()) return std::nullopt;
  CycleEvidence evidence = combine(parts);
  evidence.period_samples = period;
  evidence.cycles = static_cast<double>(recording.pv.size()) / period;
  return evidence;
}

/// Mean over the parts; -1 when op or pv stands still in all of them.
double coherence_at(const Recording& recording, double period) {
  const CycleBand band(period);
  const std::vector<CycleRecord> parts = parts_of(recording, band);
  double sum = 0.0;
  for (const CycleRecord& part : parts) sum += op_coherence(part, band);
  return parts.empty() ? -1.0 : sum / static_cast<double>(parts.size());
}

/// The period at which op repeats itself best.
double period_of(const Recording& recording) {
  const std::vector<double> periods = candidate_periods(recording.error, recording.op);
  if (periods.size() == 1) return periods.front();
  return *std::ranges::max_element(periods, {},
                                   [&](double period) { return coherence_at(recording, period); });
}

/// Share of the linear error that the valve of the law takes away.
double law_gain(const CycleEvidence& e) {
  constexpr double kLeastError = 1e-3;
  return (e.error_before - e.error_law) / (e.error_before + kLeastError);
}

/// A triangle counts as far as op has a steady shape at all.
double steady_triangle(const CycleEvidence& e) {
  const double weight = std::clamp((e.op_coherence - 0.5) / 0.35, 0.0, 1.0);
  return weight * std::clamp(e.op_triangle, -0.1, 0.12);
}

/// Logistic regression on simulated recordings, see README.limit_cycle.md. The limits keep one
/// figure far outside of what was simulated from deciding alone.
double score_of(const CycleEvidence& e) {
  constexpr double kLeastRatio = 1e-3;
  const double log_ratio = std::log(std::max(e.part_ratio, kLeastRatio));
  const double z = -13.084 - 1.762 * std::clamp(log_ratio, -1.5, 0.1) +
                   1.989 * std::clamp(law_gain(e), -0.5, 0.9) + 2.4 * e.steadiness +
                   3.134 * std::clamp(e.band_share, 0.0, 1.5) + 28.823 * steady_triangle(e) +
                   8.698 * std::clamp(e.op_coherence, 0.4, 1.0) +
                   3.808 * std::clamp(e.pv_triangle, 0.2, 0.8);
  return 1.0 / (1.0 + std::exp(-z));
}

std::string figure(double value, int decimals = 2) {
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::fixed, decimals);
  return end.ec == std::errc() ? std::string(text.data(), end.ptr) : "?";
}

std::string reason_for(const CycleEvidence& e) {
  return "A valve that moves where op turns leaves " + figure(e.part_ratio) +
         " of a linear process's error (median; lower in " + figure(100.0 * e.steadiness, 0) +
         " % of the parts). Held out, a valve with S " + figure(e.stickband) + " and J " +
         figure(e.slip_jump) + " leaves " + figure(e.error_law) + " of pv, a linear process " +
         figure(e.error_before) + ". op repeats its half cycle to " +
         figure(100.0 * e.op_coherence, 0) + " %, triangularity " + figure(e.op_triangle) +
         " (0 sine, 0.11 triangle); wave shape index of pv " + figure(e.pv_triangle) + ".";
}

}  // namespace

CycleCause judge_limit_cycle(std::span<const double> pv, std::span<const double> op,
                             std::span<const double> sp) {
  if (pv.size() != op.size() || (!sp.empty() && sp.size() != pv.size())) {
    throw std::invalid_argument("judge_limit_cycle: pv, op and sp of different lengths");
  }
  CycleCause cause;
  const Recording recording = prepare(pv, op, sp);
  cause.reason = unusable(recording);
  if (!cause.reason.empty()) return cause;
  const std::optional<CycleEvidence> best = gather(recording, period_of(recording));
  cause.reason = "op stands still for most of the record.";
  if (!best) return cause;
  cause.evidence = *best;
  cause.score = score_of(cause.evidence);
  cause.reason = reason_for(cause.evidence);
  if (cause.evidence.cycles < kFewestCycles) return cause;
  cause.decision =
      cause.score >= 0.5 ? CycleCause::Decision::sticks : CycleCause::Decision::does_not_stick;
  return cause;
}

}  // namespace loopscope::core::model
