#include "core/model/controller/excitation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/model/controller/octave_power.hpp"
#include "core/model/controller/shared_moves.hpp"
#include "core/signal/order/spread.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

/// Good positioners resolve about a tenth of a percent: less does not reach the valve.
constexpr double kLeastSpanPercent = 0.1;
/// A move of fewer steps of op's grid has no shape that a model could follow.
constexpr double kLeastSteps = 3.0;
/// Two cycles: less is a trend, which drift explains as well.
constexpr std::size_t kLeastReversals = 4;
constexpr double kReversalShare = 0.1;
/// op that stands still for most of the record says nothing of most of it.
constexpr double kMostStill = 0.8;
/// chi-squared of three degrees of freedom at 1e-3, Bonferroni over a dozen time scales, doubled
/// for moves that are no white noise.
constexpr double kLeastChiSquared = 45.0;
constexpr double kLeastShared = 0.05;
/// Response of the model against the noise of pv: at 0.2 the gain stands twelve standard errors
/// from zero in 4096 samples.
constexpr double kLeastResponse = 0.2;
constexpr double kLowerShare = 0.01;
constexpr double kUpperShare = 0.99;

double central_span(std::span<const double> samples) {
  std::vector<double> values;
  std::ranges::copy_if(samples, std::back_inserter(values),
                       [](double v) { return std::isfinite(v); });
  if (values.empty()) return 0.0;
  const auto at = [&](double share) {
    const auto place = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  const double low = at(kLowerShare);
  return at(kUpperShare) - low;
}

/// Turns by more than `size`.
std::size_t count_reversals(std::span<const double> samples, double size) {
  std::size_t turns = 0;
  int direction = 0;
  double extreme = 0.0;
  bool started = false;
  for (const double v : samples) {
    if (!std::isfinite(v)) continue;
    if (!started) extreme = v;
    started = true;
    const double away = v - extreme;
    const bool onward = direction == 0 ? std::abs(away) > size : away * direction > 0.0;
    const bool back = direction != 0 && away * direction < -size;
    if (!onward && !back) continue;
    turns += back ? 1 : 0;
    direction = away > 0.0 ? 1 : -1;
    extreme = v;
  }
  return turns;
}

std::optional<double> response_to_noise(const ExcitationRecord& record) {
  if (record.response.empty()) return std::nullopt;
  const auto response = signal::measure_spread(record.response);
  const std::vector<OctavePower> octaves = octave_powers(record.pv);
  if (!response || octaves.empty() || !(octaves.front().power > 0.0)) return std::nullopt;
  return response->std / std::sqrt(octaves.front().power);
}

/// Why not; empty = nothing speaks against it.
std::string objection(const Excitation& found, bool related, bool in_percent) {
  if (!(found.op_span > 0.0)) return "op does not move.";
  if (in_percent && found.op_span < kLeastSpanPercent) {
    return text::sentence("op spans ", found.op_span, " %, less than a valve resolves (",
                          kLeastSpanPercent, " %).");
  }
  if (found.op_steps < kLeastSteps)
    return text::sentence("op spans only ", found.op_steps, " times its smallest step.");
  if (found.still_share > kMostStill) {
    return text::sentence("op stands still for ", text::whole_percent(found.still_share),
                          " % of the record at a stretch.");
  }
  if (found.reversals < kLeastReversals)
    return text::sentence("op turns only ", found.reversals,
                          found.reversals == 1 ? " time." : " times.");
  if (!related) {
    return text::sentence("pv moves on its own: op shares ", text::whole_percent(found.shared),
                          " % of its moves.");
  }
  if (found.response_to_noise.value_or(kLeastResponse) < kLeastResponse) {
    return text::sentence("the part of pv that follows op is only ", *found.response_to_noise,
                          " times its noise.");
  }
  return {};
}

std::string describe(const Excitation& found, const std::string& objection, bool in_percent) {
  if (!objection.empty()) return text::sentence("Not excited: ", objection);
  return text::sentence("op spans ", found.op_span, in_percent ? " %" : " op units (range unknown)",
                        ", turns ", found.reversals, " times and shares ",
                        text::whole_percent(found.shared), " % of pv's moves.");
}

}  // namespace

Excitation judge_excitation(const ExcitationRecord& record) {
  const bool response_fits = record.response.empty() || record.response.size() == record.pv.size();
  if (record.op.size() != record.pv.size() || !response_fits) {
    throw std::invalid_argument("excitation: series of different lengths");
  }
  Excitation found;
  found.op_span = central_span(record.op);
  const double grid = signal::smallest_step(record.op).value_or(0.0);
  found.op_steps = grid > 0.0 ? found.op_span / grid : 0.0;
  found.reversals = count_reversals(record.op, kReversalShare * found.op_span);
  found.still_share = static_cast<double>(signal::longest_flat_run(record.op)) /
                      static_cast<double>(std::max<std::size_t>(1, record.op.size()));
  const SharedMoves shared = find_shared_moves(record.op, record.pv);
  found.shared = shared.r_squared;
  found.response_to_noise = response_to_noise(record);
  const bool related = shared.chi_squared >= kLeastChiSquared && shared.r_squared >= kLeastShared;
  const std::string why_not = objection(found, related, record.op_in_percent);
  found.sufficient = why_not.empty();
  found.statement = describe(found, why_not, record.op_in_percent);
  return found;
}

}  // namespace loopscope::core::model
