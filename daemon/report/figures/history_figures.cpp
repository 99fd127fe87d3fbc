#include "daemon/report/figures/history_figures.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/report/figures/gnuplot_text.hpp"
#include "daemon/report/figures/time_axis.hpp"

namespace loopscope::daemon {
namespace {

using storage::HistoryPoint;
using History = std::span<const HistoryPoint>;

constexpr int kHeight = 320;  // of Figure

struct HistoryCurve {
  std::string_view block;
  std::string_view title;
  std::string_view colour;
  std::optional<double> HistoryPoint::*figure;
};

struct Panel {
  std::vector<HistoryCurve> curves;
  std::string_view label;
  double least_top;  ///< the axis reaches at least so far: small noise stays small
};

std::vector<Panel> panels_of() {
  return {{{{"ngi", "NGI", colour::kBlue, &HistoryPoint::ngi},
            {"nli", "NLI", colour::kVermillion, &HistoryPoint::nli}},
           "indices (share)",
           0.02},
          {{{"low", "Harris, lowest", colour::kGreen, &HistoryPoint::harris_low},
            {"high", "Harris, highest", colour::kPurple, &HistoryPoint::harris_high}},
           "Harris (share)",
           1.0},
          {{{"std", "error, standard deviation", colour::kBlack, &HistoryPoint::error_std}},
           "error",
           0.0}};
}

std::vector<Point> points_of(History history, const HistoryCurve& curve) {
  std::vector<Point> points;
  for (const HistoryPoint& slot : history)
    points.push_back({seconds_of(slot.slot_end_us), (slot.*curve.figure).value_or(NAN)});
  return points;
}

double top_of(History history, const Panel& panel) {
  double top = panel.least_top;
  for (const HistoryCurve& curve : panel.curves)
    for (const HistoryPoint& slot : history)
      top = std::max(top, (slot.*curve.figure).value_or(0.0));
  return top;
}

/// A line, and a dot for each slot: a lone slot between gaps has no line.
std::string plot(const Panel& panel) {
  std::string text;
  for (const HistoryCurve& curve : panel.curves)
    text += fmt::format(
        "{0}${1} using 1:2 {2} title '{3}', ${1} using 1:2 with circles linecolor rgb '{4}' "
        "fillstyle solid noborder notitle",
        text.empty() ? "" : ", ", curve.block, line_style(curve.colour), curve.title, curve.colour);
  return "plot " + text + "\n";
}

}  // namespace

std::vector<Figure> history_figures(History history, const TimeZone& zone) {
  if (history.size() < 2) return {};
  const std::int64_t from = history.front().slot_end_us;
  const std::int64_t to = history.back().slot_end_us;
  const std::vector<Panel> panels = panels_of();
  std::string script;
  for (const Panel& panel : panels)
    for (const HistoryCurve& curve : panel.curves)
      script += data_block(curve.block, points_of(history, curve));
  script += "set style circle radius screen 0.0035\nset multiplot\n";
  const int count = static_cast<int>(panels.size());
  for (int k = 0; k < count; ++k) {
    const Panel& shown = panels[static_cast<std::size_t>(k)];
    script += panel(k, count, kHeight) +
              (k + 1 == count ? time_axis(from, to, zone) : silent_time_axis(from, to, zone)) +
              value_axis(0.0, top_of(history, shown), shown.label) + plot(shown);
  }
  Figure figure{"Indices over time, one point per window",
                "NGI, NLI, Harris index and spread of the error in past windows",
                script + "unset multiplot\n"};
  figure.height = kHeight;
  return {figure};
}

}  // namespace loopscope::daemon
