#include "core/repair/figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace loopscope::core::repair {
namespace {

// Sizes of effects scatter by about an eighth from window to window, as spreads do.
constexpr std::array kKinds{
    FigureKind{"controller_gain", "", true, 0.01, 0.01, "%/pv",
               "Gain of the PI controller, as the loop model reads it from op"},
    FigureKind{"cost", "", true, 0.12, 0.12, "pv units",
               "error_std over the root of the Harris index: half of it counts what the error is, "
               "half what a better controller could take away"},
    FigureKind{"curvature", "curve", true, 0.12, 0.08, "", "Curvature of valve or process"},
    FigureKind{"error_std", "", true, 0.07, 0.12, "pv units", "Standard deviation of the error"},
    FigureKind{"external_oscillation.amplitude", "oscillation", true, 0.12, 0.08, "pv units",
               "Amplitude of the sinusoid from outside"},
    FigureKind{"external_oscillation.period_s", "", true, 0.05, 0.05, "s", "Its period"},
    FigureKind{"friction_band", "friction", true, 0.12, 0.08, "% of op",
               "What the valve loses at a reversal: stick band or play"},
    FigureKind{"harris", "", true, 0.15, 0.05, "0 to 1",
               "Harris index, middle of the plausible delays"},
    FigureKind{"integral_time_s", "", true, 0.01, 0.01, "s", "Its integral time"},
    FigureKind{"ngi", "", false, 0.0015, 0.0, "", "Non-Gaussianity index"},
    FigureKind{"nli", "", false, 0.03, 0.0, "", "Nonlinearity index"},
    FigureKind{"nonlinear_p", "", false, 1.0, 0.0, "powers of ten",
               "Evidence for nonlinearity: -log10 of nonlinear_p, at most 30"},
    FigureKind{"oscillation_share", "", false, 0.1, 0.1, "0 to 1",
               "Share of the error's variance that the oscillation carries; 0 = none"},
    FigureKind{"sensor_hold.samples", "sensor", true, 0.12, 0.08, "samples",
               "How long the sensor holds a value"},
    FigureKind{"sensor_quantisation.step", "sensor", true, 0.12, 0.08, "pv units",
               "Grid of the sensor"},
    FigureKind{"valve_deadband.width", "", true, 0.12, 0.08, "% of op",
               "Full width of the valve's play"},
    FigureKind{"valve_saturation.high", "", false, 2.0, 1.0, "% of op", "Upper limit of the valve"},
    FigureKind{"valve_saturation.low", "", false, 2.0, 1.0, "% of op", "Lower limit of the valve"},
    FigureKind{"valve_stiction.J", "", true, 0.3, 0.1, "% of op", "Slip jump of the valve"},
    FigureKind{"valve_stiction.S", "", true, 0.12, 0.08, "% of op", "Stick band of the valve"},
    FigureKind{"valve_travel_per_h", "", true, 0.12, 0.12, "%/h", "Sum of op movements"},
};

static_assert(std::ranges::is_sorted(kKinds, {}, &FigureKind::name));

/// The figure that a parameter of an effect is a value of.
struct FittedFigure {
  std::string_view figure, effect, parameter;
};

constexpr std::array kFitted{
    FittedFigure{"curvature", "valve_characteristic", "curvature"},
    FittedFigure{"curvature", "process_nonlinearity", "curvature"},
    FittedFigure{"external_oscillation.amplitude", "external_oscillation", "amplitude"},
    FittedFigure{"external_oscillation.period_s", "external_oscillation", "period_s"},
    FittedFigure{"friction_band", "valve_stiction", "S"},
    FittedFigure{"friction_band", "valve_deadband", "width"},
    FittedFigure{"sensor_hold.samples", "sensor_hold", "samples"},
    FittedFigure{"sensor_quantisation.step", "sensor_quantisation", "step"},
    FittedFigure{"valve_deadband.width", "valve_deadband", "width"},
    FittedFigure{"valve_saturation.high", "valve_saturation", "high"},
    FittedFigure{"valve_saturation.low", "valve_saturation", "low"},
    FittedFigure{"valve_stiction.J", "valve_stiction", "J"},
    FittedFigure{"valve_stiction.S", "valve_stiction", "S"},
};

/// What is ordinary for a figure counts as much as so many windows (storage/DECISIONS.md).
constexpr double kPriorFreedom = 4.0;
/// p below it is no stronger evidence: the tails that it rests on say nothing there.
constexpr double kLeastP = 1e-30;

std::optional<double> cost_of(const RepairWindow& window) {
  if (!window.error_std || !window.harris || *window.harris <= 0.0) return std::nullopt;
  return *window.error_std / std::sqrt(*window.harris);
}

std::optional<double> oscillation_share(const RepairWindow& window) {
  if (!window.oscillating) return 0.0;
  if (!window.oscillation_amplitude || window.error_std.value_or(0.0) <= 0.0) return std::nullopt;
  const double ratio = *window.oscillation_amplitude / *window.error_std;
  return std::min(0.5 * ratio * ratio, 1.0);
}

std::optional<double> nonlinearity_evidence(const RepairWindow& window) {
  if (!window.nonlinear_p) return std::nullopt;
  return -std::log10(std::max(*window.nonlinear_p, kLeastP));
}

/// Of an effect that entered twice the step that came first.
std::optional<double> fitted(const RepairWindow& window, const FigureKind& kind) {
  for (const EffectParameter& found : window.effects)
    for (const FittedFigure& figure : kFitted)
      if (figure.figure == kind.name && figure.effect == found.effect &&
          figure.parameter == found.parameter)
        return kind.is_ratio ? std::abs(found.value) : found.value;
  return std::nullopt;
}

/// A figure of the window itself, beside those of fitted effects.
struct WindowFigure {
  std::string_view name;
  std::optional<double> (*value)(const RepairWindow&);
};

constexpr std::array kOfWindow{
    WindowFigure{"controller_gain", [](const RepairWindow& w) { return w.controller_gain; }},
    WindowFigure{"cost", cost_of},
    WindowFigure{"error_std", [](const RepairWindow& w) { return w.error_std; }},
    WindowFigure{"harris", [](const RepairWindow& w) { return w.harris; }},
    WindowFigure{"integral_time_s", [](const RepairWindow& w) { return w.integral_time_s; }},
    WindowFigure{"ngi", [](const RepairWindow& w) { return w.ngi; }},
    WindowFigure{"nli", [](const RepairWindow& w) { return w.nli; }},
    WindowFigure{"nonlinear_p", nonlinearity_evidence},
    WindowFigure{"oscillation_share", oscillation_share},
    WindowFigure{"valve_travel_per_h", [](const RepairWindow& w) { return w.valve_travel_per_h; }},
};

std::optional<double> value_of(const RepairWindow& window, const FigureKind& kind) {
  const auto* found = std::ranges::find(kOfWindow, kind.name, &WindowFigure::name);
  return found == kOfWindow.end() ? fitted(window, kind) : found->value(window);
}

/// Standard error of the figure in one window, where it is known: of ln(error_std).
double own_error(const RepairWindow& window, const FigureKind& kind) {
  const bool of_the_error = kind.name == "error_std" || kind.name == "cost";
  return of_the_error ? 0.5 * window.error_log_variance_se.value_or(0.0) : 0.0;
}

/// One side's values on the scale on which they are compared.
struct Side {
  std::size_t windows = 0;
  double mean = 0.0, squares = 0.0;  ///< squared deviations from the mean
  double own = 0.0;                  ///< sum of the squared own standard errors
};

Side side_of(std::span<const RepairWindow> windows, const FigureKind& kind) {
  Side side;
  for (const RepairWindow& window : windows) {
    const std::optional<double> value = value_of(window, kind);
    if (!value || !std::isfinite(*value) || (kind.is_ratio && *value <= 0.0)) continue;
    const double y = kind.is_ratio ? std::log(*value) : *value;
    const double step = y - side.mean;
    side.mean += step / static_cast<double>(++side.windows);
    side.squares += step * (y - side.mean);
    side.own += std::pow(own_error(window, kind), 2);
  }
  return side;
}

/// The 95 % point of Student's t: the first terms of Cornish and Fisher's series in 1 / freedom,
/// 0.8 % short at four and less above. Judgements that were stored rest on it.
double student_95(double freedom) {
  return 1.645 + 1.524 / freedom + 1.42 / (freedom * freedom);
}

Interval interval(double middle, double half, bool is_ratio) {
  if (!is_ratio) return {middle, middle - half, middle + half};
  return {std::exp(middle), std::exp(middle - half), std::exp(middle + half)};
}

FigureChange compare(const FigureKind& kind, const Side& before, const Side& after) {
  const auto n1 = static_cast<double>(before.windows), n2 = static_cast<double>(after.windows);
  const double freedom = kPriorFreedom + std::max(n1 - 1.0, 0.0) + std::max(n2 - 1.0, 0.0);
  const double own = (before.own + after.own) / (n1 + n2);
  const double scatter =
      (kPriorFreedom * (kind.ordinary * kind.ordinary + own) + before.squares + after.squares) /
      freedom;
  const double t = student_95(freedom);
  FigureChange result{&kind, before.windows, after.windows, {}, {}, {}, {}};
  if (before.windows > 0)
    result.before = interval(before.mean, t * std::sqrt(scatter / n1), kind.is_ratio);
  if (after.windows > 0)
    result.after = interval(after.mean, t * std::sqrt(scatter / n2), kind.is_ratio);
  if (!result.before || !result.after) return result;
  const double change = after.mean - before.mean;
  const double half = t * std::sqrt(scatter / n1 + scatter / n2 + kind.apart * kind.apart);
  result.change = interval(change, half, kind.is_ratio);
  result.weight = change / half;
  return result;
}

}  // namespace

std::span<const FigureKind> figure_kinds() {
  return kKinds;
}

std::vector<FigureChange> compare_figures(const RepairWindows& windows) {
  std::vector<FigureChange> changes;
  for (const FigureKind& kind : kKinds) {
    const Side before = side_of(windows.before, kind), after = side_of(windows.after, kind);
    if (before.windows + after.windows > 0) changes.push_back(compare(kind, before, after));
  }
  return changes;
}

}  // namespace loopscope::core::repair
