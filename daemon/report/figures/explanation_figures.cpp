#include "daemon/report/figures/explanation_figures.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/signal/grid.hpp"
#include "core/signal/order/spread.hpp"
#include "daemon/report/figures/gnuplot_text.hpp"
#include "daemon/report/figures/shown_model.hpp"
#include "daemon/report/figures/time_axis.hpp"
#include "daemon/report/text/page_text.hpp"

namespace loopscope::daemon {
namespace {

using core::model::ExplanationTraces;
using core::model::TraceStage;
using Series = std::vector<double>;

/// More stages than this are rare; the first and the last ones show what matters.
constexpr std::size_t kMostStages = 5;
constexpr int kPanelHeight = 108;
constexpr int kAxisHeight = 70;

struct Span {
  std::size_t from = 0;
  std::size_t samples = 0;
};

/// Stages that change the model, the linear one first.
std::vector<const TraceStage*> stages_to_show(const ExplanationTraces& traces) {
  std::vector<const TraceStage*> stages;
  for (const TraceStage& stage : traces.stages) stages.push_back(&stage);
  if (stages.size() > kMostStages)
    stages.erase(stages.begin() + 1, stages.end() - (kMostStages - 1));
  return stages;
}

std::string stage_words(const TraceStage& stage) {
  return stage.effect ? "+ " + in_words(name(*stage.effect)) : "linear model";
}

Series part(const Series& series, const Span& span) {
  if (series.size() < span.from + span.samples) return {};
  const auto begin = series.begin() + static_cast<std::ptrdiff_t>(span.from);
  return {begin, begin + static_cast<std::ptrdiff_t>(span.samples)};
}

/// Lowest and highest value of several series.
struct Limits {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void hold(const Series& series) {
    const auto spread = core::signal::measure_spread(series);
    if (!spread) return;
    low = std::min(low, spread->low);
    high = std::max(high, spread->high);
  }
  [[nodiscard]] bool empty() const { return low > high; }
};

/// Panels of stages, one above the other, on one time axis and one scale.
class StagePanels {
 public:
  StagePanels(const LoopEvidence& evidence, const Span& span, const TimeZone& zone)
      : zone_(zone), span_(span), interval_s_(evidence.prepared.sample_interval_s) {
    const core::signal::LoopWindow& window = evidence.at_slot.window;
    const core::signal::Grid grid{window.start_us, interval_s_, window.size()};
    from_us_ = grid.time_us(span.from);
    to_us_ = grid.time_us(span.from + span.samples - 1);
  }

  /// `measured`: the scale is made for it; what leaves it is cut off.
  [[nodiscard]] std::string data(const std::string& block, const Series& series, bool measured) {
    const Series shown = part(series, span_);
    if (measured) limits_.hold(shown);
    return data_block(block, envelope(shown, seconds_of(from_us_), interval_s_, kPictureColumns));
  }

  /// `plots`: what each panel draws.
  [[nodiscard]] std::string script(const std::vector<std::string>& plots, const std::string& label,
                                   int height) const {
    std::string text = "set multiplot\n";
    const int count = static_cast<int>(plots.size());
    for (int k = 0; k < count; ++k) {
      const bool last = k + 1 == count;
      text +=
          panel(k, count, height) +
          (last ? time_axis(from_us_, to_us_, zone_) : silent_time_axis(from_us_, to_us_, zone_)) +
          value_axis(limits_.low - kRoom * span(), limits_.high + kRoom * span(), label) + "plot " +
          plots[static_cast<std::size_t>(k)] + "\n";
    }
    return text + "unset multiplot\n";
  }

  [[nodiscard]] bool empty() const { return limits_.empty(); }

 private:
  /// A model that runs away leaves the picture, but not at once.
  static constexpr double kRoom = 0.15;
  [[nodiscard]] double span() const { return limits_.high - limits_.low; }

  const TimeZone& zone_;
  Span span_;
  double interval_s_;
  std::int64_t from_us_ = 0;
  std::int64_t to_us_ = 0;
  Limits limits_;
};

int height_of(std::size_t stages) {
  return std::max(Figure{}.height, static_cast<int>(stages) * kPanelHeight + kAxisHeight);
}

std::vector<Figure> fit_figure(const LoopEvidence& evidence, const ExplanationTraces& traces,
                               const TimeZone& zone) {
  const Span span{traces.telling_from, traces.telling_samples};
  if (span.samples < 2) return {};
  const std::vector<const TraceStage*> stages = stages_to_show(traces);
  const ShownModel model = shown_model(traces.measured, stages, span.from, span.samples);
  StagePanels panels(evidence, span, zone);
  std::string script = panels.data("measured", traces.measured, true);
  std::vector<std::string> plots;
  for (const TraceStage* stage : stages) {
    const std::string block = fmt::format("model{}", plots.size());
    script += panels.data(block, model.series_of(*stage), false);
    plots.push_back(fmt::format("$measured using 1:2 {} {}, ${} using 1:2 {} title '{}'",
                                line_style(colour::kBlue, 1.0),
                                plots.empty() ? "title 'measured'" : "notitle", block,
                                line_style(colour::kVermillion, 1.4), stage_words(*stage)));
  }
  if (panels.empty()) return {};
  const int height = height_of(plots.size());
  Figure figure{
      "Measured against model, before and after each added effect",
      fmt::format("measured process variable and the model, {}, one panel a stage", model.words()),
      script + panels.script(plots, "pv", height)};
  figure.height = height;
  return {figure};
}

std::vector<Figure> residual_figure(const LoopEvidence& evidence, const ExplanationTraces& traces,
                                    const TimeZone& zone) {
  StagePanels panels(evidence, {0, traces.measured.size()}, zone);
  std::string script;
  std::vector<std::string> plots;
  for (const TraceStage* stage : stages_to_show(traces)) {
    if (stage->one_step_residual.empty()) continue;
    const std::string block = fmt::format("residual{}", plots.size());
    script += panels.data(block, stage->one_step_residual, true);
    plots.push_back(fmt::format("${} using 1:2 {} title '{}'", block,
                                line_style(stage->effect ? colour::kGreen : colour::kGrey, 0.8),
                                stage_words(*stage)));
  }
  if (panels.empty()) return {};
  const int height = height_of(plots.size());
  Figure figure{"Residuals of the prediction one sample ahead",
                "what each stage of the model leaves, one panel a stage, all on one scale",
                script + panels.script(plots, "residual", height)};
  figure.height = height;
  return {figure};
}

}  // namespace

std::vector<Figure> explanation_figures(const LoopEvidence& evidence, const TimeZone& zone) {
  if (!evidence.traces || !evidence.traces->explanation.excited) return {};
  std::vector<Figure> figures = fit_figure(evidence, *evidence.traces, zone);
  for (Figure& figure : residual_figure(evidence, *evidence.traces, zone))
    figures.push_back(std::move(figure));
  return figures;
}

}  // namespace loopscope::daemon
