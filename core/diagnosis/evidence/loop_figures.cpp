#include "core/diagnosis/evidence/loop_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/diagnosis/evidence/nonlinearity.hpp"
#include "core/diagnosis/evidence/structure.hpp"

namespace loopscope::core::diagnosis {
namespace {

using Value = std::optional<double>;

/// The implied closed loop; nullptr where no controller was found, or the model claims nothing.
const model::ClosedLoop* closed_loop(const Evidence& evidence) {
  const bool known = evidence.model && evidence.model->excited && evidence.model->closed_loop;
  return known ? &*evidence.model->closed_loop : nullptr;
}

/// A peak sensitivity above this says no more.
constexpr double kMostSensitive = 20.0;

Value sensitivity(const Evidence& evidence) {
  const model::ClosedLoop* loop = closed_loop(evidence);
  if (!loop || std::isnan(loop->peak_sensitivity)) return std::nullopt;
  return std::min(loop->peak_sensitivity, kMostSensitive);
}

template <auto member>
Value of_loop(const Evidence& evidence) {
  const model::ClosedLoop* loop = closed_loop(evidence);
  if (!loop) return std::nullopt;
  return loop->*member;
}

/// Distance of the oscillation from the implied loop's own period.
Value off_resonance(const Evidence& evidence) {
  const model::ClosedLoop* loop = closed_loop(evidence);
  const double period_s = evidence.oscillation.period_s.value_or(0.0);
  if (!loop || !(period_s > 0.0) || !(loop->period_s > 0.0)) return std::nullopt;
  return std::abs(std::log(period_s / loop->period_s));
}

/// Integral action of SIMC tuning by the recorded one.
Value slowness(const Evidence& evidence) {
  const model::ClosedLoop* loop = closed_loop(evidence);
  if (!loop || evidence.integrating || !(loop->slowness > 0.0)) return std::nullopt;
  return loop->slowness;
}

/// Lags and dead time of the process; nullopt where the model claims nothing.
Value residence_s(const Evidence& evidence) {
  if (!closed_loop(evidence) || evidence.integrating) return std::nullopt;
  const model::ProcessFit& process = evidence.model->baseline.process;
  const double sum_s = process.time_constant_s + process.second_time_constant_s + process.delay_s;
  return sum_s > 0.0 ? Value(sum_s) : std::nullopt;
}

/// Time that the closed loop takes to make up for a load by the process's own.
Value slower_than_process(const Evidence& evidence) {
  const Value process_s = residence_s(evidence);
  if (!process_s) return std::nullopt;
  const double action_per_s =
      std::abs(evidence.model->baseline.process.gain * closed_loop(evidence)->integral_per_s);
  if (!(action_per_s > 0.0)) return std::nullopt;
  return 1.0 / (action_per_s * *process_s);
}

Value memory_by_delay(const Evidence& evidence) {
  const loop::Performance& performance = evidence.performance;
  if (!performance.error_memory_s || !(performance.longest_delay_s > 0.0)) return std::nullopt;
  return *performance.error_memory_s / performance.longest_delay_s;
}

/// Samples say little of a loop: only where nothing tells how fast the process is.
Value memory_unmodelled(const Evidence& evidence) {
  return residence_s(evidence) ? std::nullopt : memory_by_delay(evidence);
}

Value middle_harris(const Evidence& evidence) {
  const loop::Performance& performance = evidence.performance;
  if (evidence.integrating || !performance.harris_low || !performance.harris_high)
    return std::nullopt;
  return std::sqrt(*performance.harris_low * *performance.harris_high);
}

Value memory_by_process(const Evidence& evidence) {
  const Value process_s = residence_s(evidence);
  if (!process_s || !evidence.performance.error_memory_s) return std::nullopt;
  return *evidence.performance.error_memory_s / *process_s;
}

Value reversals(const Evidence& evidence) {
  if (!evidence.performance.reversals_per_h) return std::nullopt;
  constexpr double kHour_s = 3600.0;
  return *evidence.performance.reversals_per_h * evidence.interval_s / kHour_s;
}

Value clear_oscillation(const Evidence& evidence) {
  if (!evidence.oscillation.p) return std::nullopt;
  return decades(*evidence.oscillation.p);
}

Value oscillation_share(const Evidence& evidence) {
  const double amplitude = evidence.oscillation.amplitude.value_or(0.0);
  const double std = evidence.performance.error_std.value_or(0.0);
  if (!(std > 0.0)) return std::nullopt;
  return evidence.oscillation.present ? std::min(1.0, 0.5 * amplitude * amplitude / (std * std))
                                      : 0.0;
}

Value persistence(const Evidence& evidence) {
  return evidence.oscillation.present ? evidence.oscillation.persistence : std::nullopt;
}

Value regularity(const Evidence& evidence) {
  return evidence.oscillation.regularity;
}

template <auto member>
Value hos_decades(const Evidence& evidence) {
  if (!evidence.hos || !((*evidence.hos).*member)) return std::nullopt;
  return decades(*((*evidence.hos).*member));
}

Value nonlinear_decades(const Evidence& evidence) {
  if (!evidence.hos || !evidence.hos->nonlinear_p) return std::nullopt;
  return decades(nonlinear_p(evidence));
}

template <auto member>
Value hos_size(const Evidence& evidence) {
  if (!evidence.hos) return std::nullopt;
  return std::abs((*evidence.hos).*member);
}

template <auto member>
Value noise_decades(const Evidence& evidence) {
  if (!evidence.hos || !evidence.hos->noise) return std::nullopt;
  return decades((*evidence.hos->noise).*member);
}

template <auto member>
Value data(const Evidence& evidence) {
  return evidence.data_quality.*member;
}

Value flag(const Evidence& evidence, const char* name) {
  return has_flag(evidence, name) ? 1.0 : 0.0;
}

/// Gain of valve and process, % of pv's range by % of op's; at most, since lags lower it.
Value size_of_valve(const Evidence& evidence) {
  const loop::ValveGain& gain = evidence.valve_gain;
  if (!evidence.op_range_set || !gain.pv_span_percent || !gain.op_span_percent) return std::nullopt;
  if (!(*gain.op_span_percent > 0.0)) return std::nullopt;
  return *gain.pv_span_percent / *gain.op_span_percent;
}

constexpr std::array kLoopFigures = {
    Figure{"model.sensitivity", "peak sensitivity of the implied loop (20 = 20 or more)",
           Scale::plain, sensitivity},
    Figure{"model.damping", "damping of the implied loop", Scale::plain,
           of_loop<&model::ClosedLoop::damping>},
    Figure{"model.off_resonance", "ln of the oscillation's period over the implied loop's",
           Scale::plain, off_resonance},
    Figure{"model.slowness", "integral action of SIMC tuning over the recorded one", Scale::plain,
           slowness},
    Figure{"model.memory",
           "decay time of the error's autocorrelation over the time the controller needs",
           Scale::plain, memory_by_controller},
    Figure{"model.slower_than_process",
           "time to make up for a load, over the process's own time to settle", Scale::plain,
           slower_than_process},
    Figure{"model.memory_by_process",
           "decay time of the error's autocorrelation over the process's own times", Scale::plain,
           memory_by_process},
    Figure{"oscillation.p", "an oscillation is present", Scale::decades, clear_oscillation},
    Figure{"oscillation.share", "share of the error's variance that oscillates", Scale::share,
           oscillation_share},
    Figure{"oscillation.persistence", "the oscillation keeps its height", Scale::share,
           persistence},
    Figure{"oscillation.regularity", "regularity of the error's zero crossings", Scale::plain,
           regularity},
    Figure{"error.harris", "Harris index, middle of the plausible delays", Scale::plain,
           middle_harris},
    Figure{"error.memory",
           "decay time of the error's autocorrelation over the longest plausible dead time",
           Scale::plain, memory_by_delay},
    Figure{"error.memory_unmodelled",
           "decay time of the error's autocorrelation over the longest plausible dead time "
           "(process unknown)",
           Scale::plain, memory_unmodelled},
    Figure{"op.reversals", "reversals of op a sample", Scale::plain, reversals},
    Figure{"hos.nonlinear_p", "phase coupling of the error", Scale::decades, nonlinear_decades},
    Figure{"hos.ngi_p", "quadratic phase coupling of the error, on average", Scale::decades,
           hos_decades<&hos::Result::ngi_p>},
    Figure{"hos.cubic_p", "cubic phase coupling of the error", Scale::decades,
           hos_decades<&hos::Result::cubic_p>},
    Figure{"hos.skewness", "skewness of the error (size)", Scale::plain,
           hos_size<&hos::Result::skewness>},
    Figure{"hos.kurtosis", "excess kurtosis of the error", Scale::plain,
           [](const Evidence& e) { return e.hos ? Value(e.hos->excess_kurtosis) : std::nullopt; }},
    Figure{"noise.tails", "the disturbance has outliers", Scale::decades,
           noise_decades<&hos::NoiseShape::tails_p>},
    Figure{"noise.bursts", "the disturbance comes in bursts", Scale::decades,
           noise_decades<&hos::NoiseShape::variance_p>},
    Figure{"data.grid", "grid of pv over its standard deviation", Scale::plain,
           data<&signal::DataQuality::quantisation_factor>},
    Figure{"data.samples_per_value", "samples for each new value of pv", Scale::plain,
           data<&signal::DataQuality::compression_factor>},
    Figure{"data.held", "pv is renewed less often than it is recorded", Scale::yes_no,
           [](const Evidence& e) { return flag(e, "pv_held"); }},
    Figure{"data.frozen", "pv stands still although it should not", Scale::yes_no,
           [](const Evidence& e) { return flag(e, "pv_frozen"); }},
    Figure{"data.spikes", "pv has single samples far outside", Scale::yes_no,
           [](const Evidence& e) { return flag(e, "pv_spikes"); }},
    Figure{"data.setpoint_moves", "the setpoint moves all the time", Scale::yes_no,
           [](const Evidence& e) { return flag(e, "sp_moving"); }},
    Figure{"data.integrates", "the loop's vessel integrates (catalogue)", Scale::yes_no,
           [](const Evidence& e) { return Value(e.integrating ? 1.0 : 0.0); }},
    Figure{"op.at_limit", "time of op at a limit of its range", Scale::share,
           data<&signal::DataQuality::saturated_fraction>},
    Figure{"size.gain", "pv's travel over op's, both in percent of their ranges", Scale::plain,
           size_of_valve},
};

}  // namespace

std::span<const Figure> loop_figures() {
  return kLoopFigures;
}

std::optional<double> memory_by_controller(const Evidence& evidence) {
  const model::ClosedLoop* loop = closed_loop(evidence);
  const loop::Performance& performance = evidence.performance;
  if (!loop || evidence.integrating || !performance.error_memory_s) return std::nullopt;
  if (loop->integral_per_s == 0.0) return std::nullopt;
  const double usual_s = performance.longest_delay_s + loop->integral_time_s;
  if (!(usual_s > 0.0)) return std::nullopt;
  return *performance.error_memory_s / usual_s;
}

}  // namespace loopscope::core::diagnosis
