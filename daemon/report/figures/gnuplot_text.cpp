#include "daemon/report/figures/gnuplot_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

#include "core/signal/microseconds.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

constexpr double kDay_s = 86'400.0;
/// Words of a time axis stand side by side on a picture this wide.
constexpr double kMostTics = 6.0;

/// Distances between tics that people count in.
constexpr std::array kSteps_s{
    1.0,      2.0,      5.0,       10.0,      15.0,      30.0,      60.0,       120.0,     300.0,
    600.0,    900.0,    1800.0,    3600.0,    7200.0,    10800.0,   21600.0,    43200.0,   kDay_s,
    172800.0, 604800.0, 1209600.0, 2592000.0, 5184000.0, 7776000.0, 15552000.0, 31536000.0};

double tic_step_s(double span_s) {
  for (const double step : kSteps_s) {
    if (span_s / step <= kMostTics) return step;
  }
  return std::ceil(span_s / kMostTics / kSteps_s.back()) * kSteps_s.back();
}

/// 1, 2 or 5 times a power of ten, some four of them within `span`.
double round_step(double span) {
  constexpr double kSteps = 4.0;
  const double rough = span / kSteps;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (rough <= factor * decade) return factor * decade;
  }
  return 10.0 * decade;
}

std::string_view tic_format(double step_s) {
  if (step_s < 60.0) return "%H:%M:%S";
  if (step_s < kDay_s) return "%H:%M";
  return step_s < 90.0 * kDay_s ? "%d %b" : "%b %Y";
}

std::string day(std::int64_t time_us) {
  return format_time(time_us).substr(0, 10);
}

std::string time_label(std::int64_t from_us, std::int64_t to_us) {
  const std::string from = day(from_us);
  const std::string to = day(to_us);
  if (from == to) return fmt::format("time (UTC) on {}", from);
  return fmt::format("time (UTC), {} to {}", from, to);
}

std::string time_range(std::int64_t from_us, std::int64_t to_us) {
  const double from = seconds_of(from_us);
  const double to = std::max(seconds_of(to_us), from + 1.0);
  return fmt::format("set xrange [{:.3f}:{:.3f}]\nset xtics {}\n", from, to, tic_step_s(to - from));
}

}  // namespace

double seconds_of(std::int64_t time_us) {
  return static_cast<double>(time_us) / core::signal::kMicrosecondsPerSecond;
}

std::string data_block(std::string_view name, std::span<const Point> points) {
  std::string text = fmt::format("${} << EOD\n", name);
  for (const Point& point : points) {
    if (std::isfinite(point.y))
      fmt::format_to(std::back_inserter(text), "{:.13g} {:.6g}\n", point.x, point.y);
    else
      text += '\n';
  }
  return text + "EOD\n";
}

std::string picture_start(int width, int height) {
  return fmt::format(
      "reset\n"
      "set terminal svg size {},{} fixed font 'Arial,12' linewidth 1\n"
      "set border 3 linecolor rgb '#888888' linewidth 0.8\n"
      "set tics nomirror out scale 0.5 textcolor rgb '#333333'\n"
      "set grid linecolor rgb '#dddddd' linetype 1 linewidth 0.6\n"
      "set key at graph 1,1.02 right bottom horizontal samplen 2 textcolor rgb '#333333'\n"
      "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n",
      width, height, 72.0 / width, 1.0 - 20.0 / width);
}

std::string time_axis(std::int64_t from_us, std::int64_t to_us) {
  const double step = tic_step_s(seconds_of(to_us) - seconds_of(from_us));
  return time_range(from_us, to_us) +
         fmt::format("set xtics time format '{}' offset 0,0.4\nset xlabel '{}' offset 0,0.6\n",
                     tic_format(step), time_label(from_us, to_us));
}

std::string silent_time_axis(std::int64_t from_us, std::int64_t to_us) {
  return time_range(from_us, to_us) + "set xtics time format ''\nunset xlabel\n";
}

std::string value_axis(double low, double high, std::string_view label) {
  constexpr double kAir = 0.06;
  double span = high - low;
  // A constant still has to be seen as a line within its axis.
  if (!(span > 0.0)) span = std::max(std::abs(high) * 0.02, 1e-9);
  return fmt::format("set yrange [{:.9g}:{:.9g}]\nset ytics {:.9g}\nset ylabel '{}' offset 1,0\n",
                     low - kAir * span, high + kAir * span, round_step(span), label);
}

std::string panel(int index, int count, int height) {
  constexpr double kTop = 22.0;     // the key of the first panel
  constexpr double kBottom = 48.0;  // tics and label of the time axis
  constexpr double kGap = 22.0;     // the key of the next panel
  const double each = (height - kTop - kBottom - kGap * (count - 1)) / count;
  const double top = kTop + index * (each + kGap);
  return fmt::format("set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n",
                     1.0 - top / height, 1.0 - (top + each) / height);
}

std::string line_style(std::string_view colour, double width) {
  return fmt::format("with lines linecolor rgb '{}' linewidth {}", colour, width);
}

}  // namespace loopscope::daemon
