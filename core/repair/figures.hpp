#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/repair/repair_windows.hpp"

namespace loopscope::core::repair {

/// A figure that is compared before and after a repair. The view `figure_kind` of the results
/// schema, which explains the names to people, is checked against these.
struct FigureKind {
  std::string_view name;    ///< "error_std", "valve_stiction.S", ...
  std::string_view family;  ///< of faults whose size it is; empty = it sizes none
  bool is_ratio = true;     ///< compared as a ratio, by logarithms; else as a difference
  /// Ordinary standard deviation from window to window, of the logarithm where is_ratio, else in
  /// `unit`.
  double ordinary = 0.0;
  /// Ordinary standard deviation between two states of a loop that nobody touched, whatever the
  /// number of windows. Both were measured on simulated loops (storage/MEASURED.md).
  double apart = 0.0;
  std::string_view unit;
  std::string_view meaning;
};

/// All of them, in the order of their names.
[[nodiscard]] std::span<const FigureKind> figure_kinds();

/// A value with its 90 % interval.
struct Interval {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// One figure on either side, and how it changed. Of ratios `before` and `after` are geometric
/// means and `change` is after over before, else arithmetic ones and after minus before.
struct FigureChange {
  const FigureKind* kind = nullptr;                   ///< one of figure_kinds()
  std::size_t windows_before = 0, windows_after = 0;  ///< that have the figure
  std::optional<Interval> before, after;              ///< nullopt = no window has it
  std::optional<Interval> change;                     ///< nullopt = one side has no such figure
  /// The change over half its interval: beyond -1 and 1 it is significant. Empty as `change` is.
  std::optional<double> weight;
};

/// Every figure that at least one window has (finite, and > 0 if a ratio), by name. The scatter of
/// both sides is pooled and drawn towards what is ordinary for the figure, as if that were known
/// from four windows more (a moderated t, Smyth 2004), so that a single window has an interval too:
///   scatter^2 = (4 (ordinary^2 + own^2) + Q) / f,        f = 4 + (n1 - 1) + (n2 - 1)
///   change +- t(95 %, f) sqrt(scatter^2 (1 / n1 + 1 / n2) + apart^2)
/// with Q the squared deviations from the sides' means and `own` the figure's own standard error.
[[nodiscard]] std::vector<FigureChange> compare_figures(const RepairWindows& windows);

}  // namespace loopscope::core::repair
