#include "core/model/limit_cycle/limit_cycle_cause.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

#include "core/model/limit_cycle/cycle_evidence.hpp"
#include "core/model/limit_cycle/cycle_pace.hpp"
#include "core/model/limit_cycle/cycle_recording.hpp"
#include "core/model/valve_law/op_turns.hpp"
#include "core/signal/order/spread.hpp"

namespace loopscope::core::model {
namespace {

constexpr double kFewestJudged = 5.0;
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
std::optional<CycleEvidence> gather(const CycleRecording& recording, double period) {
  const CycleBand band(period);
  std::vector<CycleEvidence> parts;
  for (const CycleRecord& part : parts_of(recording, band))
    parts.push_back(gather_cycle_evidence(part, band));
  if (parts.empty()) return std::nullopt;
  CycleEvidence evidence = combine(parts);
  evidence.period_samples = period;
  evidence.pace = pace_by_size(recording.error, period);
  evidence.cycles = static_cast<double>(recording.pv.size()) / period;
  return evidence;
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

/// Logistic regression on simulated recordings, see MEASURED.md. The limits keep one
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
         " of the error that a linear process leaves (median of the record's parts; less in " +
         figure(100.0 * e.steadiness, 0) + " % of them). On held-out samples a valve with S " +
         figure(e.stickband) + " % and J " + figure(e.slip_jump) + " % leaves " +
         figure(e.error_law) + " of pv's variance, a linear process " + figure(e.error_before) +
         ". op repeats its half cycle to " + figure(100.0 * e.op_coherence, 0) +
         " %, triangularity " + figure(e.op_triangle) +
         " (0 sine, 0.11 triangle); wave shape index of pv " + figure(e.pv_triangle) + ".";
}

constexpr double kRestingSetpoint = 0.1;
/// Between one, where op follows the setpoint, and two.
constexpr double kFaster = 1.5;

}  // namespace

double CycleEvidence::process_lag() const {
  if (integrating) return 1.0;
  if (!(period_samples > 0.0)) return 0.0;
  constexpr double kQuarters = 2.0 / std::numbers::pi;
  return kQuarters * std::atan(2.0 * std::numbers::pi * lag_samples / period_samples);
}

CycleCause judge_limit_cycle(std::span<const double> pv, std::span<const double> op,
                             std::span<const double> sp, const Without& without) {
  const CycleRecording recording = cycle_recording(pv, op, sp);
  CycleCause cause;
  cause.reason = unusable(recording);
  if (!cause.reason.empty()) return cause;
  const std::optional<CycleEvidence> best = gather(recording, cycle_period(recording, without));
  cause.reason = "op stands still for most of the record.";
  if (!best) return cause;
  cause.evidence = *best;
  cause.score = score_of(cause.evidence);
  cause.reason = reason_for(cause.evidence);
  if (cause.evidence.cycles < kFewestJudged) return cause;
  cause.decision =
      cause.score >= 0.5 ? CycleCause::Decision::sticks : CycleCause::Decision::does_not_stick;
  return cause;
}

CycleCause cycle_of(const ModelInput& input) {
  return input.cycle ? *input.cycle
                     : judge_limit_cycle(input.pv, input.op, input.sp, input.without);
}

bool setpoint_moves(const ModelInput& input) {
  const auto sp = signal::measure_spread(input.sp);
  const auto pv = signal::measure_spread(input.pv);
  return sp && pv && sp->std > kRestingSetpoint * pv->std;
}

bool driven_by_setpoint(const ModelInput& input, const CycleEvidence& cycle) {
  if (!setpoint_moves(input)) return false;
  const double sp_std = signal::measure_spread(input.sp)->std;
  const double cycles = 0.5 * static_cast<double>(find_op_turns(input.sp, sp_std).size());
  return cycle.cycles <= kFaster * cycles;
}

}  // namespace loopscope::core::model
