#include "core/signal/judge_quality.hpp"

#include <cmath>
#include <string>

#include "core/signal/gaps.hpp"
#include "core/signal/op_scale.hpp"
#include "core/signal/spread.hpp"

namespace loopscope::core::signal {
namespace {

/// pv that stands still for so many samples while op moves is a dead transmitter or archive.
constexpr std::size_t kFrozenSamples = 300;

/// A grid step above this share of pv's standard deviation shapes the statistics
/// (Thornhill, Choudhury and Shah 2004).
constexpr double kCoarseQuantisation = 0.4;

/// A pv that is renewed less often than every third sample is not the signal that the grid claims;
/// compressed archives mislead the statistics from 2.5 to 3 on (Thornhill, Choudhury and Shah
/// 2004).
constexpr double kStaleFactor = 3.0;

/// A mean error of so many standard deviations is no control error: the controller is not in
/// command (override, protection) or has no integral action and no room.
constexpr double kFarFromSetpoint = 5.0;

/// A setpoint that moves in more than half of the samples comes from another controller.
constexpr double kMovingSetpoint = 0.5;

/// With the loop open for most of the window there is no control to judge.
constexpr double kMostlyManual = 0.5;

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

std::string percent_text(double share_of_one) {
  return std::to_string(std::lround(100.0 * share_of_one)) + " %";
}

double share_of_moves(const Samples& samples) {
  std::size_t pairs = 0;
  std::size_t moves = 0;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    if (std::isnan(samples[k]) || std::isnan(samples[k - 1])) continue;
    ++pairs;
    if (samples[k] != samples[k - 1]) ++moves;
  }
  return share(moves, pairs);
}

/// Share of the samples with a known mode that the controller was in manual.
double manual_fraction(const std::vector<ControlMode>& mode) {
  std::size_t known = 0;
  std::size_t manual = 0;
  for (const ControlMode sample : mode) {
    if (sample != ControlMode::unknown) ++known;
    if (sample == ControlMode::manual) ++manual;
  }
  return share(manual, known);
}

/// Why the window cannot be judged; empty when it can.
std::string unusable_reason(const PreparedLoop& loop, double missing,
                            const PrepareSettings& settings) {
  const std::optional<Spread> pv = measure_spread(loop.pv);
  if (!pv) return "pv has no usable sample";
  if (pv->constant()) return "pv is constant";
  const double manual = manual_fraction(loop.mode);
  if (manual > kMostlyManual) {
    return "the controller was in manual for " + percent_text(manual) + " of the window";
  }
  const std::size_t usable = count_recorded(loop.error);
  if (usable < settings.min_usable_samples) {
    return std::to_string(usable) + " usable samples, at least " +
           std::to_string(settings.min_usable_samples) + " are needed";
  }
  if (missing > settings.max_missing_fraction) {
    return percent_text(missing) + " of the pv samples are missing, at most " +
           percent_text(settings.max_missing_fraction) + " may be";
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

/// Samples per renewal of pv. A coarse grid repeats values without being stale: nullopt then.
std::optional<double> compression_factor(const Samples& pv, double quantisation) {
  const double moves = share_of_moves(pv);
  if (moves <= 0.0 || quantisation > kCoarseQuantisation) return std::nullopt;
  return 1.0 / moves;
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
  flags.add(share_of_moves(loop.sp) > kMovingSetpoint, "sp_moving");
  flags.add(far_from_setpoint(loop.error), "sp_not_followed");
  flags.add(loop.spikes > 0, "pv_spikes");
  flags.add(pv && pv->constant(), "pv_constant");
  flags.add(quality.quantisation_factor.value_or(0.0) > kCoarseQuantisation, "pv_quantised");
  flags.add(quality.compression_factor.value_or(1.0) >= kStaleFactor, "pv_held");
  flags.add(loop.op_moves && longest_flat_run(loop.pv) >= kFrozenSamples, "pv_frozen");
  flags.add(!has_op, "op_missing");
  flags.add(has_op && !loop.op_moves, "op_constant");
  flags.add(has_op && !loop.op_range_known, "op_range_unknown");
  flags.add(manual_fraction(loop.mode) > 0.0, "manual_mode");
  flags.add(loop.repeated_times > 0, "repeated_times");
}

}  // namespace

DataQuality judge_quality(const PreparedLoop& loop, const PrepareSettings& settings) {
  DataQuality quality;
  const double missing = 1.0 - share(loop.pv_recorded, loop.pv.size());
  quality.repeated_times = loop.repeated_times;
  quality.missing_fraction = missing;
  quality.quantisation_factor = quantisation_factor(loop.pv);
  quality.compression_factor =
      compression_factor(loop.pv, quality.quantisation_factor.value_or(0.0));
  if (loop.op_range_known) quality.saturated_fraction = fraction_at_limit(loop.op_percent);
  raise_flags(loop, quality);
  quality.reason = unusable_reason(loop, missing, settings);
  quality.usable = quality.reason.empty();
  return quality;
}

}  // namespace loopscope::core::signal
