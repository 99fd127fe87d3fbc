#include "daemon/report/figures/gnuplot_text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace loopscope::daemon {
namespace {

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

}  // namespace

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

std::string value_axis(double low, double high, std::string_view label) {
  constexpr double kAir = 0.06;
  double span = high - low;
  // A constant still has to be seen as a line within its axis.
  if (!(span > 0.0)) span = std::max(std::abs(high) * 0.02, 1e-9);
  return fmt::format("set yrange [{:.9g}:{:.9g}]\nset ytics {:.9g}\n", low - kAir * span,
                     high + kAir * span, round_step(span)) +
         value_label(label);
}

std::string value_label(std::string_view label) {
  constexpr int kTag = 99;  // far from those that gnuplot gives labels by itself
  return fmt::format("set label {} '{}' at graph 0, graph 1 left offset 0.3,0.6\n", kTag, label);
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
