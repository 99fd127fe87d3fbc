#include "daemon/report/figures/signal_figures.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "core/signal/grid.hpp"
#include "core/signal/order/spread.hpp"
#include "daemon/report/figures/gnuplot_text.hpp"
#include "daemon/report/figures/time_axis.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::Samples;

/// A curve of a panel.
struct SignalCurve {
  std::string_view name;  ///< data block and word in the key
  std::span<const double> samples;
  std::string_view style;  ///< colour
  bool dashed = false;
};

std::span<const double> part(const Samples& samples, const Stretch& stretch) {
  if (samples.size() < stretch.from + stretch.samples) return {};
  return std::span(samples).subspan(stretch.from, stretch.samples);
}

class Panels {
 public:
  Panels(const LoopEvidence& evidence, const Stretch& stretch, const TimeZone& zone)
      : zone_(zone), interval_s_(evidence.prepared.sample_interval_s) {
    const core::signal::LoopWindow& window = evidence.at_slot.window;
    const core::signal::Grid grid{window.start_us, interval_s_, window.size()};
    from_us_ = grid.time_us(stretch.from);
    to_us_ = grid.time_us(stretch.from + std::max<std::size_t>(stretch.samples, 1) - 1);
  }

  void add(std::vector<SignalCurve> curves, std::string_view label) {
    std::erase_if(curves, [](const SignalCurve& curve) {
      return !core::signal::measure_spread(curve.samples).has_value();
    });
    if (!curves.empty()) panels_.push_back({std::move(curves), label});
  }

  [[nodiscard]] std::string script(int height) const {
    std::string text;
    for (const Panel& panel : panels_) text += data_of(panel);
    text += "set multiplot\n";
    const int count = static_cast<int>(panels_.size());
    for (int k = 0; k < count; ++k) {
      const bool last = k + 1 == count;
      text +=
          panel(k, count, height) +
          (last ? time_axis(from_us_, to_us_, zone_) : silent_time_axis(from_us_, to_us_, zone_)) +
          plot(panels_[static_cast<std::size_t>(k)]);
    }
    return text + "unset multiplot\n";
  }

 private:
  struct Panel {
    std::vector<SignalCurve> curves;
    std::string_view label;
  };

  [[nodiscard]] std::string data_of(const Panel& panel) const {
    std::string text;
    for (const SignalCurve& curve : panel.curves)
      text += data_block(
          curve.name, envelope(curve.samples, seconds_of(from_us_), interval_s_, kPictureColumns));
    return text;
  }

  static std::string plot(const Panel& panel) {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    std::string curves;
    for (const SignalCurve& curve : panel.curves) {
      const auto spread = core::signal::measure_spread(curve.samples);
      low = std::min(low, spread->low);
      high = std::max(high, spread->high);
      curves += fmt::format("{}${} using 1:2 {} {} title '{}'", curves.empty() ? "" : ", ",
                            curve.name, line_style(curve.style, curve.dashed ? 1.6 : 1.1),
                            curve.dashed ? "dashtype 2" : "", curve.name);
    }
    return value_axis(low, high, panel.label) + "plot " + curves + "\n";
  }

  const TimeZone& zone_;
  double interval_s_;
  std::int64_t from_us_ = 0;
  std::int64_t to_us_ = 0;
  std::vector<Panel> panels_;
};

std::string_view op_label(const LoopEvidence& evidence) {
  const bool percent = evidence.prepared.op_in_percent();
  const bool position = !evidence.prepared.mv_percent.empty();
  if (position) return percent ? "op, mv (%)" : "op, mv (op units)";
  return percent ? "op (%)" : "op (op units)";
}

Figure trend(const LoopEvidence& evidence, const Stretch& stretch, const TimeZone& zone,
             std::string title) {
  const core::signal::PreparedLoop& loop = evidence.prepared;
  Panels panels(evidence, stretch, zone);
  panels.add({{"pv", part(loop.pv, stretch), colour::kBlue},
              {"sp", part(loop.sp, stretch), colour::kBlack, true}},
             loop.sp.empty() ? "pv" : "sp, pv");
  panels.add({{"op", part(loop.op_percent, stretch), colour::kVermillion},
              {"mv", part(loop.mv_percent, stretch), colour::kGreen}},
             op_label(evidence));
  Figure figure{std::move(title), "set point, process variable and controller output over time",
                ""};
  figure.script = panels.script(figure.height);
  return figure;
}

/// Behind the last sample that is there.
std::size_t recorded_end(const Samples& samples) {
  std::size_t end = samples.size();
  while (end > 0 && !std::isfinite(samples[end - 1])) --end;
  return end;
}

std::vector<Point> pairs(std::span<const double> x, std::span<const double> y) {
  std::vector<Point> points;
  for (std::size_t k = 0; k < std::min(x.size(), y.size()); ++k) {
    const bool known = std::isfinite(x[k]) && std::isfinite(y[k]);
    points.push_back(known ? Point{x[k], y[k]} : Point{0.0, NAN});
  }
  return points;
}

}  // namespace

Stretch telling_stretch(const LoopEvidence& evidence) {
  if (evidence.traces && evidence.traces->telling_samples > 1)
    return {evidence.traces->telling_from, evidence.traces->telling_samples};
  constexpr double kCycles = 8.0;
  constexpr double kFewest = 200.0;
  constexpr double kMost = 800.0;
  const core::loop::Oscillation& swing = evidence.diagnosis.evidence.oscillation;
  const double period = swing.present && swing.period_s
                            ? *swing.period_s / evidence.prepared.sample_interval_s
                            : kFewest / kCycles;
  const auto wanted = static_cast<std::size_t>(std::clamp(kCycles * period, kFewest, kMost));
  const std::size_t end = recorded_end(evidence.prepared.pv);
  const std::size_t samples = std::min(wanted, end);
  return {end - samples, samples};
}

std::vector<Figure> trend_figures(const LoopEvidence& evidence, const TimeZone& zone) {
  if (evidence.prepared.pv.empty()) return {};
  Figure whole = trend(evidence, {0, evidence.prepared.pv.size()}, zone, "Trends, whole window");
  whole.whole_window = true;
  return {std::move(whole),
          trend(evidence, telling_stretch(evidence), zone, "Trends, a few cycles of it")};
}

std::vector<Figure> valve_figures(const LoopEvidence& evidence) {
  const core::signal::PreparedLoop& loop = evidence.prepared;
  const Stretch stretch = telling_stretch(evidence);
  const auto op = part(loop.op_percent, stretch);
  const bool measured = !loop.mv_percent.empty();
  const auto answer = part(measured ? loop.mv_percent : loop.pv, stretch);
  const auto points = pairs(op, answer);
  if (std::ranges::none_of(points, [](const Point& point) { return std::isfinite(point.y); }))
    return {};
  const std::string_view unit = loop.op_in_percent() ? "%" : "op units";
  const std::string answer_label =
      measured ? fmt::format("valve position mv ({})", unit) : std::string("pv");
  Figure figure{measured ? "Valve position over controller output"
                         : "Process variable over controller output",
                "phase plot of the telling stretch: play and stiction show as a parallelogram",
                data_block("orbit", points)};
  figure.script +=
      panel(0, 1, figure.height) +
      fmt::format("set xlabel 'controller output op ({})' offset 0,0.6\n", unit) +
      value_label(answer_label) +
      "set autoscale\nunset key\nset offsets graph 0.04, graph 0.04, graph 0.04, graph 0.04\n"
      "plot $orbit using 1:2 " +
      line_style(colour::kBlue, 0.8) + "\n";
  return {figure};
}

}  // namespace loopscope::daemon
