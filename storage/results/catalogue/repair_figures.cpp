#include "storage/results/catalogue/repair_figures.hpp"

#include <cmath>
#include <optional>

#include "storage/array_literal.hpp"

namespace loopscope::storage {
namespace {

using core::repair::FigureChange;
using core::repair::Interval;

std::string json_number(double value) {
  // JSON has no infinity: the exponential of an interval may be one.
  return std::isfinite(value) ? number_text(value) : "null";
}

std::string interval_json(const std::string& name, const std::optional<Interval>& interval) {
  const auto field = [&](const char* end, double Interval::*part) {
    return ",\"" + name + end + "\":" + (interval ? json_number((*interval).*part) : "null");
  };
  return field("", &Interval::value) + field("_low", &Interval::low) +
         field("_high", &Interval::high);
}

std::string figure_json(const FigureChange& figure) {
  return "\"" + std::string(figure.kind->name) +
         "\":{\"n_before\":" + std::to_string(figure.windows_before) +
         ",\"n_after\":" + std::to_string(figure.windows_after) +
         ",\"is_ratio\":" + (figure.kind->is_ratio ? "true" : "false") +
         interval_json("before", figure.before) + interval_json("after", figure.after) +
         interval_json("change", figure.change) + "}";
}

}  // namespace

std::string figures_json(std::span<const FigureChange> figures) {
  std::string json = "{";
  for (const FigureChange& figure : figures)
    json += (json.size() > 1 ? "," : "") + figure_json(figure);
  return json + "}";
}

}  // namespace loopscope::storage
