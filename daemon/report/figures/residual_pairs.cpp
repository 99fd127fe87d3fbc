#include "daemon/report/figures/residual_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/model/display_window.hpp"
#include "core/model/effects/effect_catalogue.hpp"
#include "core/signal/grid.hpp"
#include "core/signal/order/spread.hpp"
#include "daemon/report/figures/gnuplot_text.hpp"
#include "daemon/report/figures/time_axis.hpp"
#include "daemon/report/text/page_text.hpp"

namespace loopscope::daemon {
namespace {

using core::model::ExplanationTraces;
using core::model::Range;
using core::model::TraceStage;
using Series = std::vector<double>;

constexpr int kPairWidth = 440;
constexpr int kPairHeight = 170;
constexpr std::size_t kPairColumns = 170;

/// Two residuals of one kind, as long as the record.
struct Residuals {
  Series before;
  Series after;
};

Series rest_of(const Series& measured, const Series& simulated) {
  Series rest(measured.size());
  std::ranges::transform(measured, simulated, rest.begin(), std::minus{});
  return rest;
}

std::optional<Residuals> residuals_of(const Series& measured, const TraceStage& before,
                                      const TraceStage& after) {
  const auto whole = [&](const Series& a, const Series& b) {
    return !measured.empty() && a.size() == measured.size() && b.size() == measured.size();
  };
  if (whole(before.one_step_residual, after.one_step_residual))
    return Residuals{before.one_step_residual, after.one_step_residual};
  if (whole(before.simulated, after.simulated))
    return Residuals{rest_of(measured, before.simulated), rest_of(measured, after.simulated)};
  return std::nullopt;
}

/// As long as the stretch of the first effect, but where this one tells.
Range stretch_of(const LoopEvidence& evidence, const Residuals& residuals) {
  const ExplanationTraces& traces = *evidence.traces;
  Series gain(residuals.before.size());
  std::ranges::transform(
      residuals.before, residuals.after, gain.begin(),
      [](double before, double after) { return before * before - after * after; });
  const core::signal::Samples& op = evidence.prepared.op_percent;
  const bool helps = std::ranges::any_of(gain, [](double taken) { return taken > 0.0; });
  if (helps && op.size() == gain.size())
    return core::model::telling_stretch(op, gain, traces.telling_samples);
  return {traces.telling_from, traces.telling_from + traces.telling_samples};
}

/// The two figures of a step: one stretch, one time axis, one scale.
class PairFigures {
 public:
  PairFigures(const LoopEvidence& evidence, const Residuals& residuals, const Range& stretch,
              const TimeZone& zone)
      : zone_(zone), stretch_(stretch), interval_s_(evidence.prepared.sample_interval_s) {
    const core::signal::LoopWindow& window = evidence.at_slot.window;
    const core::signal::Grid grid{window.start_us, interval_s_, window.size()};
    from_us_ = grid.time_us(stretch.first);
    to_us_ = grid.time_us(stretch.end - 1);
    for (const Series* series : {&residuals.before, &residuals.after}) {
      const auto spread = core::signal::measure_spread(part(*series));
      if (!spread) continue;
      low_ = std::min(low_, spread->low);
      high_ = std::max(high_, spread->high);
    }
  }

  [[nodiscard]] Figure figure(const Series& series, std::string_view colour,
                              const std::string& title, const std::string& alt) const {
    const std::vector<Point> points =
        envelope(part(series), seconds_of(from_us_), interval_s_, kPairColumns);
    Figure drawn{title, alt,
                 data_block("residual", points) + "unset key\n" + panel(0, 1, kPairHeight) +
                     time_axis(from_us_, to_us_, zone_) + value_axis(low_, high_, "residual") +
                     "plot $residual using 1:2 " + line_style(colour, 1.0) + "\n"};
    drawn.width = kPairWidth;
    drawn.height = kPairHeight;
    return drawn;
  }

 private:
  [[nodiscard]] std::span<const double> part(const Series& series) const {
    return std::span(series).subspan(stretch_.first, stretch_.size());
  }

  const TimeZone& zone_;
  Range stretch_;
  double interval_s_;
  std::int64_t from_us_ = 0;
  std::int64_t to_us_ = 0;
  double low_ = 0.0;
  double high_ = 0.0;
};

std::optional<ResidualPair> pair_of(const LoopEvidence& evidence, std::size_t step,
                                    const TimeZone& zone) {
  const ExplanationTraces& traces = *evidence.traces;
  const TraceStage& after = traces.stages[step + 1];
  const auto residuals = residuals_of(traces.measured, traces.stages[step], after);
  if (!residuals) return std::nullopt;
  const Range stretch = stretch_of(evidence, *residuals);
  if (stretch.size() < 2 || stretch.end > residuals->before.size()) return std::nullopt;
  const PairFigures pair(evidence, *residuals, stretch, zone);
  const std::string effect = after.effect ? in_words(name(*after.effect)) : "the effect";
  return ResidualPair{step,
                      pair.figure(residuals->before, colour::kGrey, "Residual before",
                                  "what the model leaves without " + effect),
                      pair.figure(residuals->after, colour::kGreen, "Residual after",
                                  "what it leaves with " + effect + ", on the same scale")};
}

}  // namespace

std::vector<ResidualPair> residual_pairs(const LoopEvidence& evidence, const TimeZone& zone) {
  std::vector<ResidualPair> pairs;
  if (!evidence.traces || !evidence.traces->explanation.excited) return pairs;
  for (std::size_t step = 0; step + 1 < evidence.traces->stages.size(); ++step) {
    if (auto pair = pair_of(evidence, step, zone)) pairs.push_back(std::move(*pair));
  }
  return pairs;
}

}  // namespace loopscope::daemon
