#include "daemon/report/figures/spectrum_figures.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <numeric>
#include <optional>

#include "core/hos/kernels/principal_domain.hpp"
#include "core/loop/record_spectrum.hpp"
#include "core/signal/order/spread.hpp"
#include "core/text/phrases.hpp"
#include "daemon/report/figures/gnuplot_text.hpp"

namespace loopscope::daemon {
namespace {

/// Bins of the spectrum are averaged into as many, equally wide on a logarithmic axis, and at least
/// three into one: single ones scatter by as much as they are.
constexpr std::size_t kSpectrumColumns = 80;
constexpr std::size_t kFewestBins = 3;

/// Of a record's spectrum as density over frequency in Hz, one-sided: its integral is the variance.
std::vector<Point> density(core::loop::RecordSpectrum& spectrum, double variance,
                           double interval_s) {
  const std::vector<double>& power = spectrum.power();
  const double width_hz = spectrum.bin_width() / interval_s;
  const double total = std::accumulate(power.begin() + 1, power.end(), 0.0) * width_hz;
  std::vector<Point> points;
  const double octaves = std::log(static_cast<double>(power.size() - 1));
  for (std::size_t bin = 1; bin < power.size() && total > 0.0;) {
    const auto column = static_cast<double>(points.size() + 1);
    const double edge = std::exp(octaves * column / kSpectrumColumns);
    const std::size_t end =
        std::clamp<std::size_t>(static_cast<std::size_t>(edge) + 1,
                                std::min(bin + kFewestBins, power.size()), power.size());
    const auto first = power.begin() + static_cast<std::ptrdiff_t>(bin);
    const auto last = power.begin() + static_cast<std::ptrdiff_t>(end);
    const double mean = std::accumulate(first, last, 0.0) / static_cast<double>(end - bin);
    const double centre = std::sqrt(static_cast<double>(bin) * static_cast<double>(end - 1));
    points.push_back({centre * width_hz, mean * variance / total});
    bin = end;
  }
  return points;
}

std::vector<Point> error_density(const LoopEvidence& evidence) {
  const core::signal::Samples& error = evidence.prepared.error;
  const auto spread = core::signal::measure_spread(error);
  if (!spread || spread->constant()) return {};
  core::loop::RealTransform transform(core::loop::transform_length(error.size()));
  core::loop::RecordSpectrum spectrum(error, *spread, transform);
  return density(spectrum, spread->std * spread->std, evidence.prepared.sample_interval_s);
}

std::string marks(const core::loop::Oscillation& swing, double highest_hz) {
  if (!swing.present || !swing.period_s) return {};
  std::string text;
  for (int harmonic = 1; harmonic <= 3; ++harmonic) {
    const double hz = harmonic / *swing.period_s;
    if (hz > highest_hz) break;
    text += fmt::format(
        "set arrow from first {0:.9g}, graph 0 to first {0:.9g}, graph 1 nohead linecolor rgb "
        "'{1}' linewidth {2} dashtype {3} back\n",
        hz, colour::kVermillion, harmonic == 1 ? 1.4 : 0.8, harmonic == 1 ? 1 : 3);
  }
  return text + fmt::format(
                    "set label 'period {}' at first {:.9g}, graph 1.05 center textcolor rgb '{}'\n",
                    core::text::duration(*swing.period_s), 1.0 / *swing.period_s,
                    colour::kVermillion);
}

/// So many pixels a cell: viewers blur the edges of small pictures when they enlarge them.
constexpr std::size_t kPixelsPerCell = 4;

std::string cells(const BicoherenceMap& map) {
  const core::hos::PrincipalDomain domain(map.dft_length);
  const std::size_t half = map.dft_length / 2;
  std::string text = "$map << EOD\n";
  for (std::size_t k2 = 1; k2 <= domain.rows(); ++k2) {
    std::string row;
    for (std::size_t k1 = 1; k1 < half; ++k1) {
      const bool inside = domain.contains({k1, k2});
      const std::string value =
          inside ? fmt::format("{:.4g} ", map.bic2[domain.index({k1, k2})]) : "NaN ";
      for (std::size_t k = 0; k < kPixelsPerCell; ++k) row += value;
    }
    for (std::size_t k = 0; k < kPixelsPerCell; ++k) text += row + "\n";
  }
  return text + "EOD\n";
}

/// Viridis (van der Walt and Smith 2015): even steps to the eye, also in grey and for any colour
/// vision.
constexpr const char* kViridis =
    "set palette defined (0 '#440154', 1 '#472c7a', 2 '#3b518b', 3 '#2c718e', 4 '#21908d', "
    "5 '#27ad81', 6 '#5cc863', 7 '#aadc32', 8 '#fde725')\n";

std::string peak_marks(const BicoherenceMap& map) {
  std::string text;
  for (std::size_t k = 0; k < map.peaks.size(); ++k) {
    const double x = map.peaks[k].f1 / map.interval_s;
    const double y = map.peaks[k].f2 / map.interval_s;
    fmt::format_to(std::back_inserter(text),
                   "set object circle at {0:.9g},{1:.9g} radius screen 0.014 front fillstyle empty "
                   "border linecolor rgb '{2}' linewidth 1.6\n"
                   "set label '{3}' at {0:.9g},{1:.9g} offset 0.9,0.7 front textcolor rgb '{2}'\n",
                   x, y, colour::kVermillion, k + 1);
  }
  return text;
}

}  // namespace

std::vector<Figure> spectrum_figures(const LoopEvidence& evidence) {
  const std::vector<Point> points = error_density(evidence);
  if (points.empty()) return {};
  const double top = std::ranges::max(points, {}, &Point::y).y;
  constexpr double kDecades = 1e-7;  // below is rounding, and an empty part of the picture
  const double low = std::max(std::ranges::min(points, {}, &Point::y).y, top * kDecades);
  Figure figure{"Power spectrum of the error",
                "power density of the error over frequency; the oscillation found is marked",
                data_block("power", points)};
  figure.script += fmt::format(
      "set logscale xy\nset format xy '10^{{%L}}'\nset xrange [{:.6g}:{:.6g}]\nset yrange "
      "[{:.6g}:{:.6g}]\n",
      points.front().x, points.back().x, low / 1.5, top * 2.0);
  figure.script +=
      "set xlabel 'frequency (Hz)' offset 0,0.5\nset ylabel 'density (pv^2 / Hz)' offset "
      "1,0\nunset key\n";
  figure.script += "set bmargin at screen 0.18\nset tmargin at screen 0.90\n";
  figure.script += marks(evidence.diagnosis.evidence.oscillation, points.back().x) +
                   "plot $power using 1:2 " + line_style(colour::kBlue) + "\n";
  return {figure};
}

std::vector<Figure> bicoherence_figures(const LoopEvidence& evidence) {
  if (!evidence.map) return {};
  const BicoherenceMap& map = *evidence.map;
  // Colours that start at 0.2 at least do not blow noise up to a pattern.
  constexpr double kLeastTop = 0.2;
  const double top = std::max(kLeastTop, *std::ranges::max_element(map.bic2));
  const double step_hz = 1.0 / (map.interval_s * static_cast<double>(map.dft_length));
  const double pixel_hz = step_hz / static_cast<double>(kPixelsPerCell);
  Figure figure{map.slow ? "Squared bicoherence of the error (resampled to the slow oscillation)"
                         : "Squared bicoherence of the error",
                "which pairs of frequencies are coupled; the strongest peaks are numbered",
                cells(map)};
  figure.script += kViridis;
  figure.script +=
      fmt::format("set cbrange [0:{:.4g}]\nset cblabel 'squared bicoherence (share)'\n", top);
  figure.script += fmt::format("set xrange [0:{:.9g}]\nset yrange [0:{:.9g}]\n",
                               0.5 / map.interval_s, 0.27 / map.interval_s);
  figure.script +=
      "set xlabel 'frequency f_1 (Hz)' offset 0,0.5\nunset key\n"
      "set lmargin at screen 0.15\nset rmargin at screen 0.82\nset bmargin at screen 0.18\n"
      "set tmargin at screen 0.93\n" +
      value_label("frequency f_2 (Hz)") + peak_marks(map);
  // The first pixel's middle lies half a pixel behind the left edge of cell 1.
  figure.script += fmt::format(
      "plot $map matrix using (($1 + 0.5) * {0:.12g} + {1:.12g}):(($2 + 0.5) * {0:.12g} + "
      "{1:.12g}):3 with image\n",
      pixel_hz, 0.5 * step_hz);
  return {figure};
}

}  // namespace loopscope::daemon
