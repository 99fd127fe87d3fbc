#pragma once

#include <span>
#include <string>
#include <string_view>

#include "daemon/report/figures/min_max_envelope.hpp"

namespace loopscope::daemon {

/// Okabe and Ito's colours, which people of any colour vision tell apart; as gnuplot writes them.
namespace colour {
inline constexpr std::string_view kBlack = "#000000";
inline constexpr std::string_view kBlue = "#0072B2";
inline constexpr std::string_view kVermillion = "#D55E00";
inline constexpr std::string_view kGreen = "#009E73";
inline constexpr std::string_view kPurple = "#CC79A7";
inline constexpr std::string_view kOrange = "#E69F00";
inline constexpr std::string_view kGrey = "#666666";
}  // namespace colour

/// A data block `$name` of two columns; where y is NaN the curve is broken.
[[nodiscard]] std::string data_block(std::string_view name, std::span<const Point> points);

/// What every picture begins with: terminal, type, frame, grid, no title. CSS pixels.
[[nodiscard]] std::string picture_start(int width, int height);

/// The y axis: a range that holds `low` to `high` with a little air, and its value_label().
[[nodiscard]] std::string value_axis(double low, double high, std::string_view label);

/// The label of a y axis, above its upper end, where it may be long: upright beside the axis it is
/// cut off by the edge of the picture as soon as it is longer than the panel is high, or the
/// figures at the tics are wide. Wants the room above that panel() leaves.
[[nodiscard]] std::string value_label(std::string_view label);

/// One (`index` from 0) of `count` panels one above the other, the first on top: its margins, as
/// shares of a canvas `height` pixels high. The last one has room for the words of the x axis.
[[nodiscard]] std::string panel(int index, int count, int height);

/// "with lines" in a colour and width.
[[nodiscard]] std::string line_style(std::string_view colour, double width = 1.2);

}  // namespace loopscope::daemon
