#include "core/diagnosis/evidence/figure.hpp"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/evidence/loop_figures.hpp"
#include "core/diagnosis/evidence/shape_figures.hpp"
#include "core/diagnosis/evidence/step_figures.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::diagnosis {

std::span<const Figure> all_figures() {
  static const std::vector<Figure> all = [] {
    std::vector<Figure> figures;
    for (const auto some : {step_figures(), loop_figures(), shape_figures()})
      figures.insert(figures.end(), some.begin(), some.end());
    return figures;
  }();
  return all;
}

std::optional<std::size_t> figure_place(std::string_view name) {
  const auto found = std::ranges::find(all_figures(), name, &Figure::name);
  if (found == all_figures().end()) return std::nullopt;
  return static_cast<std::size_t>(found - all_figures().begin());
}

std::vector<std::optional<double>> measure_figures(const Evidence& evidence) {
  std::vector<std::optional<double>> values;
  values.reserve(all_figures().size());
  for (const Figure& figure : all_figures()) {
    std::optional<double> value = figure.of(evidence);
    if (value && !std::isfinite(*value)) value.reset();
    values.push_back(value);
  }
  return values;
}

std::string figure_text(const Figure& figure, double value) {
  std::string text(figure.words);
  switch (figure.scale) {
    case Scale::yes_no:
      return text + (value > 0.5 ? ": yes" : ": no");
    case Scale::share:
      return text + ": " + text::percent(value);
    case Scale::decades:
      return "test whether " + text + ": " +
             text::p_equals(value >= kMostDecades ? 0.0 : std::pow(10.0, -value));
    case Scale::plain:
      break;
  }
  return text + ": " + text::number(value);
}

double decades(double p) {
  if (!(p < 1.0)) return 0.0;
  return p > 0.0 ? std::min(-std::log10(p), kMostDecades) : kMostDecades;
}

}  // namespace loopscope::core::diagnosis
