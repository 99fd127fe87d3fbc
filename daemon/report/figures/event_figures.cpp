#include "daemon/report/figures/event_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <optional>
#include <string_view>
#include <utility>

#include "core/signal/microseconds.hpp"
#include "core/signal/order/spread.hpp"
#include "core/text/phrases.hpp"
#include "daemon/report/figures/gnuplot_text.hpp"
#include "daemon/report/figures/time_axis.hpp"

namespace loopscope::daemon {
namespace {

using storage::PlantOscillationRow;
using storage::PlantTrace;

constexpr std::array kRowColours{colour::kVermillion, colour::kBlue,   colour::kGreen,
                                 colour::kPurple,     colour::kOrange, colour::kBlack,
                                 colour::kGrey,       colour::kBlue};
constexpr int kRowHeight = 40;
constexpr int kAboutRows = 84;  // words above and axis below

/// One curve, 1 high about the middle of its row.
struct Row {
  std::size_t number = 0;  ///< of the member
  std::vector<Point> points;
};

/// From 1, as in the list of members; nullopt = a loop that has left the catalogue.
std::optional<std::size_t> number_of(const PlantOscillationRow& event, const PlantTrace& trace) {
  const auto found =
      std::ranges::find(event.members, trace.loop_id, &PlantOscillationRow::Member::loop_id);
  if (found == event.members.end()) return std::nullopt;
  return static_cast<std::size_t>(found - event.members.begin()) + 1;
}

/// To its own standard deviation: two and a half of them reach the next row.
std::vector<Point> trend_of(const PlantTrace& trace) {
  const auto spread = core::signal::measure_spread(trace.error);
  if (!spread || spread->constant()) return {};
  constexpr double kRowsPerDeviation = 0.27;
  std::vector<Point> points;
  for (std::size_t k = 0; k < trace.error.size(); ++k) {
    const double value = (trace.error[k] - spread->mean) / spread->std * kRowsPerDeviation;
    points.push_back({seconds_of(trace.start_us) + static_cast<double>(k) * trace.step_s, value});
  }
  return points;
}

/// To its own peak, from the bottom of its row up.
std::vector<Point> spectrum_of(const PlantTrace& trace) {
  if (trace.power.empty() || trace.power.size() != trace.periods_s.size()) return {};
  const double top = std::ranges::max(trace.power);
  constexpr double kRowShare = 0.85;
  std::vector<Point> points;
  for (std::size_t k = 0; k < trace.power.size() && top > 0.0; ++k)
    points.push_back({trace.periods_s[k], trace.power[k] / top * kRowShare - 0.45});
  return points;
}

std::vector<Row> rows_of(const PlantOscillationRow& event,
                         std::vector<Point> (*curve)(const PlantTrace&)) {
  std::vector<Row> rows;
  for (const PlantTrace& trace : event.traces) {
    const auto number = number_of(event, trace);
    if (!number || rows.size() == kRowColours.size()) continue;
    Row row{*number, curve(trace)};
    if (!row.points.empty()) rows.push_back(std::move(row));
  }
  std::ranges::sort(rows, {}, &Row::number);
  return rows;
}

/// The first row on top; its number stands for its name, in its colour.
std::string rows_script(std::vector<Row> rows) {
  std::string data, numbers, curves;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto middle = static_cast<double>(rows.size() - 1 - k);
    for (Point& point : rows[k].points) point.y += middle;
    data += data_block(fmt::format("row{}", k), rows[k].points);
    numbers += fmt::format("set label '{}' at graph -0.015, first {} right textcolor rgb '{}'\n",
                           rows[k].number, middle, kRowColours[k]);
    curves += fmt::format("{}$row{} using 1:2 {}", k == 0 ? "plot " : ", ", k,
                          line_style(kRowColours[k], 1.2));
  }
  return data +
         fmt::format(
             "set yrange [-0.6:{:.1f}]\nunset ytics\nunset key\nset lmargin at screen 0.055\n"
             "set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n",
             static_cast<double>(rows.size()) - 0.4,
             1.0 - 24.0 / (kAboutRows + kRowHeight * static_cast<double>(rows.size())),
             46.0 / (kAboutRows + kRowHeight * static_cast<double>(rows.size()))) +
         numbers + curves + "\n";
}

Figure stacked(std::string title, std::string alt, const std::string& axes, std::vector<Row> rows) {
  Figure figure{std::move(title), std::move(alt), "", 560};
  figure.height = kAboutRows + kRowHeight * static_cast<int>(rows.size());
  figure.script = axes + rows_script(std::move(rows));
  return figure;
}

/// First and last x of all rows.
std::pair<double, double> span_of(const std::vector<Row>& rows) {
  double from = rows.front().points.front().x, to = from;
  for (const Row& row : rows) {
    from = std::min(from, row.points.front().x);
    to = std::max(to, row.points.back().x);
  }
  return {from, to};
}

std::int64_t microseconds(double seconds) {
  return static_cast<std::int64_t>(seconds * core::signal::kMicrosecondsPerSecond);
}

/// A bar of one period above the curves.
std::string period_bar(double from_s, double period_s) {
  return fmt::format(
      "set arrow from first {0:.13g}, graph 1.02 to first {1:.13g}, graph 1.02 heads size screen "
      "0.006,90 linecolor rgb '{2}' linewidth 1.4\n"
      "set label 'one period, {3}' at first {1:.13g}, graph 1.02 offset 1,0 left textcolor rgb "
      "'{2}'\n",
      from_s, from_s + period_s, colour::kVermillion, core::text::duration(period_s));
}

std::vector<Figure> trends(const PlantOscillationRow& event, const TimeZone& zone) {
  std::vector<Row> rows = rows_of(event, trend_of);
  if (rows.empty()) return {};
  const auto [from_s, to_s] = span_of(rows);
  return {stacked("Trends of sp \u2212 pv, each to its own size",
                  "trends of the members one below the other, numbered as in the list",
                  time_axis(microseconds(from_s), microseconds(to_s), zone) +
                      period_bar(from_s, event.period_s),
                  std::move(rows))};
}

struct Tic {
  double period_s = 0.0;
  std::string_view words;
};
constexpr std::array<Tic, 17> kPeriodTics = {{{0.1, "0.1 s"},
                                              {0.3, "0.3 s"},
                                              {1.0, "1 s"},
                                              {3.0, "3 s"},
                                              {10.0, "10 s"},
                                              {30.0, "30 s"},
                                              {60.0, "1 min"},
                                              {180.0, "3 min"},
                                              {600.0, "10 min"},
                                              {1800.0, "30 min"},
                                              {3600.0, "1 h"},
                                              {10800.0, "3 h"},
                                              {36000.0, "10 h"},
                                              {86400.0, "1 d"},
                                              {259200.0, "3 d"},
                                              {864000.0, "10 d"},
                                              {2592000.0, "30 d"}}};

std::string period_axis(double from_s, double to_s) {
  std::string tics;
  for (const Tic& tic : kPeriodTics)
    if (tic.period_s >= from_s && tic.period_s <= to_s)
      tics += fmt::format("{}'{}' {:g}", tics.empty() ? "" : ", ", tic.words, tic.period_s);
  return fmt::format(
      "set logscale x\nset xrange [{:.6g}:{:.6g}]\nset xtics ({}) offset 0,0.4\nset mxtics "
      "default\nset xlabel 'period' offset 0,0.6\n",
      from_s, to_s, tics);
}

std::string period_mark(double period_s) {
  return fmt::format(
      "set arrow from first {0:.9g}, graph 0 to first {0:.9g}, graph 1 nohead linecolor rgb '{1}' "
      "linewidth 1 dashtype 2 back\n"
      "set label 'period {2}' at first {0:.9g}, graph 1.02 offset 0,0.5 center textcolor rgb "
      "'{1}'\n",
      period_s, colour::kVermillion, core::text::duration(period_s));
}

std::vector<Figure> spectra(const PlantOscillationRow& event) {
  std::vector<Row> rows = rows_of(event, spectrum_of);
  if (rows.empty()) return {};
  const auto [shortest_s, longest_s] = span_of(rows);
  // Far from the period nothing is of interest.
  constexpr double kFaster = 100.0, kSlower = 30.0, kAir = 1.03;
  const double from_s = std::max(shortest_s, event.period_s / kFaster) / kAir;
  const double to_s = std::min(longest_s, event.period_s * kSlower) * kAir;
  return {stacked("Spectra of sp \u2212 pv, each to its own peak",
                  "power of the members over the period, one below the other, numbered as in the "
                  "list; the shared period is marked",
                  period_axis(from_s, to_s) + period_mark(event.period_s), std::move(rows))};
}

}  // namespace

std::vector<Figure> event_figures(const PlantOscillationRow& event, const TimeZone& zone) {
  std::vector<Figure> figures = trends(event, zone);
  for (Figure& figure : spectra(event)) figures.push_back(std::move(figure));
  return figures;
}

}  // namespace loopscope::daemon
