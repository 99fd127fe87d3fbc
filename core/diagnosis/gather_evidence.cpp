#include "core/diagnosis/gather_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/diagnosis/archive_null.hpp"
#include "core/diagnosis/steady_error.hpp"
#include "core/diagnosis/unit_words.hpp"
#include "core/hos/slow/period.hpp"
#include "core/signal/order/spread.hpp"
#include "core/text/counted.hpp"

namespace loopscope::core {
namespace {

/// Findings on fewer segments carry the flag `short`.
constexpr std::size_t kShortSegments = 32;

std::string unusable_segments(std::size_t segments, const signal::PreparedLoop& loop) {
  const auto spread = signal::measure_spread(loop.error);
  if (spread && spread->constant()) return "the error does not vary";
  return "the gaps leave " + text::counted(segments, "unbroken segment", "unbroken segments") +
         ", at least " + std::to_string(kMinSegments) + " are needed";
}

void add_flag(signal::DataQuality& quality, const char* flag) {
  if (std::ranges::find(quality.flags, flag) == quality.flags.end()) {
    quality.flags.emplace_back(flag);
  }
}

/// The figures stay, the p-values do not.
void refuse_tests(hos::Result& result) {
  result.ngi_p.reset();
  result.nli_p.reset();
  result.cubic_p.reset();
  result.nonlinear_p.reset();
  result.innovation_p.reset();
  result.coupling = hos::Coupling::none_found;
  for (hos::Peak& peak : result.peaks) peak.p.reset();
}

/// One loop with normal noise in a thousand gets a flag of its noise.
constexpr double kOddNoise = 1e-3;

void note_noise(const std::optional<hos::NoiseShape>& noise, signal::DataQuality& quality) {
  if (!noise) return;
  if (noise->tails_p <= kOddNoise) add_flag(quality, "heavy_tails");
  if (noise->variance_p <= kOddNoise) add_flag(quality, "variance_changes");
}

/// What was found odd about the error, and what follows from it.
void note(const SteadyError& steady, signal::DataQuality& quality) {
  if (steady.flag != nullptr) add_flag(quality, steady.flag);
  if (!steady.stationary) add_flag(quality, "not_stationary");
  quality.stretch = steady.stretch;
  if (steady.refusal.empty()) return;
  quality.refusals.push_back(steady.refusal);
  add_flag(quality, "tests_refused");
}

void measure_statistics(const signal::PreparedLoop& loop, const AnalysisSettings& settings,
                        std::uint64_t seed, Evidence& evidence) {
  signal::DataQuality& quality = evidence.data_quality;
  const SteadyError steady = steady_error(loop, settings.hos, seed);
  note(steady, quality);
  evidence.hos = steady.residual.empty()
                     ? hos::analyse(steady.error, settings.hos, seed)
                     : hos::analyse(steady.error, steady.residual, settings.hos, seed);
  evidence.tested_on = steady.residual.empty() ? TestedOn::error : TestedOn::model_residual;
  if (evidence.hos && !quality.refusals.empty()) {
    refuse_tests(*evidence.hos);
  } else if (evidence.hos && loop.archive == signal::Archive::swinging_door) {
    allow_for_door(steady.tested(), loop.band, settings.hos, seed, *evidence.hos);
  }
  const std::size_t segments = evidence.hos ? evidence.hos->segments : 0;
  if (segments < kMinSegments) {
    evidence.hos.reset();
    quality.usable = false;
    quality.reason = unusable_segments(segments, loop);
  } else {
    if (segments < kShortSegments) add_flag(quality, "short");
    note_noise(evidence.hos->noise, quality);
  }
}

/// Where the record holds too few cycles of its oscillation for the harmonics' test, and for the
/// slow look, nothing was found because nothing could be.
void note_too_short(const FirstLook& first, Evidence& evidence) {
  const std::optional<double> period = first.period_samples();
  if (!period || evidence.hos_slow || !evidence.hos->nonlinear_p) return;
  if (evidence.hos->coupling != hos::Coupling::none_found) return;
  const double wanted = std::ceil(hos::kFewestCycles * *period);
  if (wanted <= static_cast<double>(first.loop.error.size())) return;
  evidence.hos->coupling = hos::Coupling::too_short;
  evidence.samples_wanted = static_cast<std::size_t>(wanted);
}

/// judge_slow_travel() averages eight samples: sixteen of its means a cycle show the shape.
constexpr double kSamplesOfTravel = 128.0;

/// Of `every` samples each; NaN where one is missing.
signal::Samples means(const signal::Samples& samples, std::size_t every) {
  signal::Samples result(samples.size() / every, 0.0);
  for (std::size_t k = 0; k < result.size() * every; ++k)
    result[k / every] += samples[k] / static_cast<double>(every);
  return result;
}

std::optional<model::SlowTravel> travel_in_cycle(const signal::PreparedLoop& loop,
                                                 double period_samples) {
  const double factor = std::floor(period_samples / kSamplesOfTravel);
  if (!(factor >= 2.0)) return std::nullopt;
  const auto every = static_cast<std::size_t>(factor);
  return model::judge_slow_travel(means(loop.pv, every), means(loop.op_percent, every));
}

void measure_cycle(const signal::PreparedLoop& loop, const LoopFacts& facts, Evidence& evidence) {
  if (!loop.op_moves) return;
  model::CycleCause cycle =
      model::judge_limit_cycle(loop.pv, loop.op_percent, loop.sp, facts.without);
  if (!(cycle.evidence.cycles > 0.0)) return;
  evidence.pv_plateaus = loop::measure_pv_plateaus(
      loop.pv, loop.op_percent, cycle.evidence.period_samples, evidence.integrating);
  evidence.cycle_travel = travel_in_cycle(loop, cycle.evidence.period_samples);
  evidence.cycle = std::move(cycle);
}

/// In automatic alone: in manual pv need not follow.
void compare_units(const signal::PreparedLoop& loop, const LoopFacts& facts, Evidence& evidence) {
  if (loop.sp.empty()) return;
  signal::Samples sp = loop.sp;
  for (std::size_t k = 0; k < sp.size(); ++k)
    if (std::isnan(loop.error[k])) sp[k] = signal::kMissing;
  std::optional<signal::OpRange> range;
  if (facts.pv_span) range = {facts.pv_low, facts.pv_low + *facts.pv_span};
  evidence.units = loop::match_units(sp, loop.pv, range);
  if (diagnosis::unit_finding(evidence) == diagnosis::UnitFinding::shown)
    add_flag(evidence.data_quality, "units_differ");
}

void measure_shapes(const FirstLook& first, const LoopFacts& facts, Evidence& evidence) {
  const signal::PreparedLoop& loop = first.loop;
  evidence.shape = loop::measure_shape({loop.error, loop.pv, loop.op_percent, loop.mv_percent,
                                        first.period_samples(), evidence.integrating});
  evidence.valve_gain = loop::measure_valve_gain(loop.pv, loop.op_percent, facts.pv_span);
  evidence.op_at_ends = loop::measure_op_at_ends(loop.op_percent);
  measure_cycle(loop, facts, evidence);
  if (loop.op_moves) evidence.travel = model::judge_slow_travel(loop.pv, loop.op_percent);
}

SteadyError long_error(const signal::LoopWindow& window, double interval_s,
                       const AnalysisSettings& settings, std::uint64_t seed) {
  if (window.sample_interval_s != interval_s) {
    throw std::invalid_argument("the long window has another sample interval than the window");
  }
  signal::PrepareSettings prepare = settings.prepare;
  prepare.window_samples = window.size();
  return steady_error(signal::prepare(window, prepare), settings.hos, seed);
}

void look_slowly(const FirstLook& first, const AnalysisSettings& settings, std::uint64_t seed,
                 const signal::LoopWindow* long_window, Evidence& evidence) {
  const std::optional<double> period = first.period_samples();
  if (!period || !hos::needs_slow_look(*period, settings.hos)) return;
  const SteadyError steady =
      long_window ? long_error(*long_window, first.loop.sample_interval_s, settings, seed)
                  : steady_error(first.loop, settings.hos, seed);
  evidence.hos_slow = hos::look_slowly(steady.error, *period, settings.hos, seed, steady.residual);
  const bool refused = !evidence.data_quality.refusals.empty() || !steady.refusal.empty();
  if (evidence.hos_slow && refused) {
    refuse_tests(evidence.hos_slow->result);
  }
}

/// What stands still in the whole window is judged by the longer one, which shows how long it
/// usually does.
void look_back(const FirstLook& first, const AnalysisSettings& settings,
               const signal::LoopWindow* long_window, Evidence& evidence) {
  if (!long_window || !first.loop.still || !first.loop.still->whole) return;
  signal::PrepareSettings prepare = settings.prepare;
  prepare.window_samples = long_window->size();
  const signal::PreparedLoop longer = signal::prepare(*long_window, prepare);
  evidence.still = longer.still;
  evidence.pv_past = longer.past;
  if (evidence.still) return;
  std::erase(evidence.data_quality.flags, "pv_frozen");
  std::erase(evidence.data_quality.flags, "pv_dead");
}

}  // namespace

Evidence gather_evidence(const FirstLook& first, const AnalysisSettings& settings,
                         const LoopFacts& facts, const signal::LoopWindow* long_window) {
  const signal::PreparedLoop& loop = first.loop;
  Evidence evidence;
  evidence.data_quality = loop.quality;
  evidence.integrating = facts.integrating;
  evidence.op_in_percent = loop.op_in_percent();
  evidence.op_range_set = loop.op_range.source == signal::RangeSource::set;
  evidence.op_range_doubt = loop.op_range.doubt;
  evidence.interval_s = loop.sample_interval_s;
  evidence.samples = loop.pv.size();
  evidence.still = loop.still;
  evidence.pv_past = loop.past;
  evidence.control = loop.control;
  look_back(first, settings, long_window, evidence);
  evidence.oscillation = first.oscillation;
  evidence.slow_span_samples = first.slow_span_samples;
  evidence.performance = loop::measure_performance(loop.error, loop.op_percent, loop.mode,
                                                   loop.sample_interval_s, settings.performance);
  evidence.performance.at_limit_fraction = evidence.data_quality.saturated_fraction;
  if (evidence.data_quality.usable) {
    measure_statistics(loop, settings, facts.seed, evidence);
    measure_shapes(first, facts, evidence);
    compare_units(loop, facts, evidence);
    if (evidence.hos) {
      look_slowly(first, settings, facts.seed, long_window, evidence);
      note_too_short(first, evidence);
    }
  }
  return evidence;
}

}  // namespace loopscope::core
