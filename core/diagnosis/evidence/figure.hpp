#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnosis/evidence/evidence.hpp"

namespace loopscope::core::diagnosis {

/// How the value of a figure is written.
enum class Scale {
  plain,    ///< a number
  share,    ///< 0 to 1, written in percent
  decades,  ///< -log10 of the p of a test whether `words`, at most kMostDecades; written as p
  yes_no,   ///< 1 or 0
};

/// Beyond this the tails that a p-value rests on are longer than any record shows.
inline constexpr double kMostDecades = 12.0;

/// One number about a loop that the causes are weighed by: without a dimension, so that loops of
/// all kinds compare. nullopt = not computed.
struct Figure {
  std::string_view name;   ///< room and figure, e.g. "cycle.op_coherence"
  std::string_view words;  ///< in a reason, before the value
  Scale scale = Scale::plain;
  std::optional<double> (*of)(const Evidence&) = nullptr;
};

/// Every figure, in a fixed order.
[[nodiscard]] std::span<const Figure> all_figures();

/// Place in all_figures(); nullopt = there is none of that name.
[[nodiscard]] std::optional<std::size_t> figure_place(std::string_view name);

/// The values of all figures, in order; NaN is "not computed", too.
[[nodiscard]] std::vector<std::optional<double>> measure_figures(const Evidence& evidence);

/// "op repeats its half cycle: 93 %".
[[nodiscard]] std::string figure_text(const Figure& figure, double value);

/// -log10 p, 0 to kMostDecades; 0 for NaN.
[[nodiscard]] double decades(double p);

}  // namespace loopscope::core::diagnosis
