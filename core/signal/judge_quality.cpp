#include "core/signal/judge_quality.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "core/signal/control_state.hpp"
#include "core/signal/gaps.hpp"
#include "core/signal/order/spread.hpp"
#include "core/signal/setpoint_moves.hpp"

namespace loopscope::core::signal {
namespace {

/// A pv that is renewed less often than every third sample is not the signal that the grid claims;
/// compressed archives mislead the statistics from 2.5 to 3 on (Thornhill, Choudhury and Shah
/// 2004).
constexpr double kStaleFactor = 3.0;

/// A mean error of so many standard deviations is no control error: the controller is not in
/// command (override, protection) or has no integral action and no room.
constexpr double kFarFromSetpoint = 5.0;

/// Of so many samples one at least has to be stored for the tests: beyond that too much of what
/// they see is the model's (README, "Samples that were not stored").
constexpr double kMostDrawn = 4.0;

std::string decimal(double value) {
  const auto tenths = std::lround(10.0 * value);
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10);
}

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

std::string percent_text(double share_of_one) {
  return std::to_string(std::lround(100.0 * share_of_one)) + " %";
}

/// Gaps of pv that were recorded: it stands still there for longer than the archive's rule
/// explains.
std::size_t recorded_gaps(const PreparedLoop& loop) {
  if (!loop.still) return 0;
  const FlatRun& run = loop.still->run;
  const auto still = std::span(loop.pv).subspan(run.first, run.samples);
  const auto gaps = std::ranges::count_if(still, [](double value) { return std::isnan(value); });
  return std::min(run.recorded, static_cast<std::size_t>(gaps));
}

/// Holes are gaps of an archive that stores every sample, and none of one that does not; what was
/// recorded is never missing.
double missing_fraction(const PreparedLoop& loop) {
  const bool by_rule = loop.archive == Archive::dead_band ||
                       loop.archive == Archive::swinging_door || loop.archive == Archive::on_change;
  const double not_recorded = 1.0 - share(loop.pv_recorded, loop.pv.size());
  const std::size_t holes = loop.pv_gaps - recorded_gaps(loop);
  return by_rule ? std::min(not_recorded, share(holes, loop.pv.size())) : not_recorded;
}

/// Why there is too little of pv: never recorded, or discarded for standing still; empty = enough.
std::string too_little(const PreparedLoop& loop, const PrepareSettings& settings) {
  const double out = share(loop.pv_gaps, loop.pv.size());
  if (out <= settings.max_missing_fraction) return {};
  const double missing = missing_fraction(loop);
  if (missing > settings.max_missing_fraction)
    return percent_text(missing) + " of the pv samples are missing, at most " +
           percent_text(settings.max_missing_fraction) + " may be";
  return percent_text(out - std::min(out, missing)) +
         " of the pv samples stand still or lie on a line and say nothing, at most " +
         percent_text(settings.max_missing_fraction) + " may";
}

/// Why the window cannot be judged; empty when it can.
std::string unusable_reason(const PreparedLoop& loop, const PrepareSettings& settings) {
  const std::optional<Spread> pv = measure_spread(loop.pv);
  if (!pv) return "pv has no usable sample";
  if (pv->constant()) return "pv is constant";
  if (std::string reason = too_little(loop, settings); !reason.empty()) return reason;
  const std::size_t usable = count_recorded(loop.error);
  if (usable < settings.min_usable_samples) {
    return std::to_string(usable) + (usable == 1 ? " usable sample" : " usable samples") +
           ", at least " + std::to_string(settings.min_usable_samples) + " are needed";
  }
  return {};
}

bool far_from_setpoint(const Samples& error) {
  const std::optional<Spread> spread = measure_spread(error);
  return spread && !spread->constant() && std::abs(spread->mean) > kFarFromSetpoint * spread->std;
}

std::optional<double> quantisation_factor(const Samples& pv) {
  const std::optional<Spread> spread = measure_spread(pv);
  const std::optional<double> step = smallest_step(pv);
  if (!spread || !step || spread->std <= 0.0) return std::nullopt;
  return *step / spread->std;
}

/// Values were put between the samples that the archive stored, or it left them out by its rule.
bool compressed(const PreparedLoop& loop) {
  switch (loop.archive) {
    case Archive::dead_band:
    case Archive::swinging_door:
      return true;
    case Archive::scattered:
      return loop.pv_recorded > loop.pv_stored + loop.spikes;
    default:
      return false;
  }
}

/// Samples outside of gaps, stored or not.
std::size_t covered(const PreparedLoop& loop) {
  return loop.pv.size() - loop.pv_gaps;
}

double samples_per_stored(const PreparedLoop& loop) {
  return loop.pv_stored == 0
             ? 1.0
             : static_cast<double>(covered(loop)) / static_cast<double>(loop.pv_stored);
}

/// Samples per renewal of pv. A coarse grid repeats values without being stale: nullopt then.
std::optional<double> compression_factor(const Samples& pv, double quantisation) {
  const double moves = share_of_moves(pv);
  if (moves <= 0.0 || quantisation > kCoarseGrid) return std::nullopt;
  return 1.0 / moves;
}

/// Stands still where other samples do not, and is masked; or although it should not.
double frozen_fraction(const PreparedLoop& loop) {
  const std::size_t others = loop.pv_stored + loop.spikes;
  const bool masked = loop.archive == Archive::complete && loop.pv_recorded > others;
  const double discarded = masked ? share(loop.pv_recorded - others, loop.pv.size()) : 0.0;
  return std::max(discarded, loop.still ? share(loop.still->run.samples, loop.pv.size()) : 0.0);
}

/// What the tests cannot be asked on these data, in plain words.
std::vector<std::string> refusals(const PreparedLoop& loop, const DataQuality& quality) {
  std::vector<std::string> reasons;
  if (loop.archive == Archive::coarser) {
    reasons.push_back("pv is renewed only every " +
                      decimal(quality.compression_factor.value_or(samples_per_stored(loop))) +
                      " samples: the loop's sample interval is too short");
  }
  const double factor = quality.drawn_fraction.value_or(0.0) < 1.0
                            ? 1.0 / (1.0 - quality.drawn_fraction.value_or(0.0))
                            : kMostDrawn;
  if (factor > kMostDrawn) {
    reasons.push_back("only one pv sample in " + decimal(factor) + " was stored, one in " +
                      decimal(kMostDrawn) + " is needed");
  }
  return reasons;
}

class Flags {
 public:
  explicit Flags(std::vector<std::string>& flags) : flags_(flags) {}
  void add(bool raised, const char* flag) {
    if (raised) flags_.emplace_back(flag);
  }

 private:
  std::vector<std::string>& flags_;
};

void raise_flags(const PreparedLoop& loop, DataQuality& quality) {
  const std::optional<Spread> pv = measure_spread(loop.pv);
  const bool has_op = count_recorded(loop.op_percent) > 0;
  Flags flags(quality.flags);
  flags.add(count_recorded(loop.sp) == 0, "sp_missing");
  flags.add(moves_most_of_the_time(loop.sp), "sp_moving");
  flags.add(far_from_setpoint(loop.error), "sp_not_followed");
  flags.add(loop.spikes > 0, "pv_spikes");
  flags.add(pv && pv->constant(), "pv_constant");
  flags.add(quality.quantisation_factor.value_or(0.0) > kCoarseGrid, "pv_quantised");
  const bool held = !compressed(loop) && quality.compression_factor.value_or(1.0) >= kStaleFactor;
  flags.add(held, "pv_held");
  flags.add(compressed(loop), "pv_compressed");
  flags.add(quality.drawn_fraction.value_or(0.0) > 0.0, "samples_drawn");
  flags.add(quality.frozen_fraction.value_or(0.0) > 0.0, "pv_frozen_masked");
  flags.add(!quality.refusals.empty(), "tests_refused");
  flags.add(loop.still.has_value(), "pv_frozen");
  flags.add(loop.still && loop.still->to_the_end, "pv_dead");
  flags.add(!has_op, "op_missing");
  flags.add(has_op && !loop.op_moves, "op_constant");
  const RangeSource source = loop.op_range.source;
  flags.add(has_op && source == RangeSource::unknown, "op_range_unknown");
  flags.add(has_op && source == RangeSource::inferred, "op_range_inferred");
  flags.add(has_op && !loop.op_range.doubt.empty(), "op_range_doubted");
  flags.add(count_modes(loop.mode).manual > 0, "manual_mode");
  flags.add(loop.repeated_times > 0, "repeated_times");
}

}  // namespace

DataQuality judge_quality(const PreparedLoop& loop, const PrepareSettings& settings) {
  DataQuality quality;
  quality.repeated_times = loop.repeated_times;
  quality.archive = loop.archive;
  quality.missing_fraction = missing_fraction(loop);
  quality.frozen_fraction = frozen_fraction(loop);
  const bool drawn = !loop.drawable.error.empty();
  quality.drawn_fraction = drawn ? share(covered(loop) - loop.pv_stored, loop.pv.size()) : 0.0;
  quality.quantisation_factor = quantisation_factor(loop.pv);
  quality.compression_factor =
      compressed(loop) ? std::optional(share(covered(loop), loop.pv_stored))
                       : compression_factor(loop.pv, quality.quantisation_factor.value_or(0.0));
  quality.refusals = refusals(loop, quality);
  quality.saturated_fraction = loop.control.at_limit_fraction;
  raise_flags(loop, quality);
  quality.reason = unusable_reason(loop, settings);
  quality.usable = quality.reason.empty();
  quality.enough = loop.pv_recorded > 0 && loop.pv.size() >= settings.min_usable_samples &&
                   *quality.missing_fraction <= settings.max_missing_fraction;
  return quality;
}

}  // namespace loopscope::core::signal
