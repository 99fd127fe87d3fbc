#include "core/signal/op_range.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/signal/order/order_statistic.hpp"

namespace loopscope::core::signal {
namespace {

/// Controllers let their output run from -6.9 to 106.9 %, as NAMUR NE 43 lets a current run from
/// 3.8 to 20.5 mA at least and the usual systems a little further.
constexpr double kBeyond = 0.07;
/// An output of 0 to 100 that never leaves 4 to 20 stays in a corner of 4 to 20 as well.
constexpr double kMostOfRange = 0.75;
/// A range that is so many times wider than the one that the values never leave is a wrong one.
constexpr double kMuchWider = 4.0;
/// A bad value or two is no range: so many are left out at either end.
constexpr double kSpared = 0.002;
/// Values so often in a row are held, not passed.
constexpr std::size_t kHeld = 3;

constexpr OpRange kShare{0.0, 1.0};
constexpr OpRange kPercent{0.0, 100.0};
constexpr OpRange kCurrent_mA{4.0, 20.0};
/// Of 8, 12, 14, 15 and 16 bits, of tenths and hundredths of a percent, and of two makers.
constexpr std::array kCounts{255.0,   1000.0,  4095.0,  10000.0, 16383.0,
                             27648.0, 32000.0, 32767.0, 65535.0};

double width(const OpRange& range) {
  return range.high - range.low;
}

bool within(const OpValues& values, const OpRange& range, double beyond) {
  return values.low >= range.low - beyond * width(range) &&
         values.high <= range.high + beyond * width(range);
}

bool is_current(const OpValues& values) {
  if (!within(values, kCurrent_mA, kBeyond * 0.5)) return false;
  return values.at_20_ma || values.high - values.low >= kMostOfRange * width(kCurrent_mA);
}

std::string number_text(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

bool is_whole(double value) {
  return std::abs(value) < 1e15 && value == std::round(value);
}

/// Why the range that was set cannot be right; empty = it can. A valve that rests at an end of the
/// range stays within a small part of it, too, and so does a percentage between 5 and 18.
std::string doubt_of(const OpValues& values, const OpRange& set) {
  if (!(values.low < values.high)) return {};
  if (!within(values, set, kBeyond))
    return "op goes from " + number_text(values.low) + " to " + number_text(values.high) +
           ", beyond " + range_text(set);
  const std::optional<OpRange> inferred = infer_op_range(values);
  const bool at_end = values.low == set.low || values.high == set.high;
  const bool may_be_percent = inferred && inferred->low == kCurrent_mA.low && !values.at_20_ma;
  const bool narrow =
      inferred && !at_end && !may_be_percent && kMuchWider * width(*inferred) <= width(set);
  return narrow ? "op never leaves " + range_text(*inferred) + " of " + range_text(set)
                : std::string();
}

}  // namespace

std::optional<OpValues> summarise_op(std::span<const double> op) {
  OpValues values{0.0, 0.0, true, false};
  std::vector<double> recorded;
  recorded.reserve(op.size());
  std::size_t held = 0;
  bool held_at_end = false;
  bool others_whole = true;
  for (const double value : op) {
    if (!std::isfinite(value)) continue;
    recorded.push_back(value);
    const bool at_end = value == kCurrent_mA.low || value == kCurrent_mA.high;
    // Both ends are whole.
    values.whole = values.whole && is_whole(value);
    others_whole = others_whole && (at_end || values.whole || is_whole(value));
    held = at_end ? held + 1 : 0;
    held_at_end = held_at_end || held >= kHeld;
  }
  if (recorded.empty()) return std::nullopt;
  const auto spared = static_cast<std::size_t>(kSpared * static_cast<double>(recorded.size()));
  values.low = order_statistic(recorded, spared);
  values.high = order_statistic(recorded, recorded.size() - 1 - spared);
  const bool constant = values.low == values.high;
  values.at_20_ma = held_at_end && (constant || !others_whole);
  return values;
}

std::optional<OpRange> infer_op_range(const OpValues& values) {
  if (within(values, kShare, kBeyond) && values.high > 0.0) return kShare;
  if (is_current(values)) return kCurrent_mA;
  if (within(values, kPercent, kBeyond)) return kPercent;
  if (!values.whole || values.low < 0.0) return std::nullopt;
  const auto* full = std::ranges::find_if(kCounts, [&](double x) { return x >= values.high; });
  return full == kCounts.end() ? std::nullopt : std::optional(OpRange{0.0, *full});
}

KnownRange find_op_range(std::span<const double> op, const std::optional<OpRange>& set) {
  const std::optional<OpValues> values = summarise_op(op);
  if (!values) return {set, set ? RangeSource::set : RangeSource::unknown, {}};
  std::string doubt = set ? doubt_of(*values, *set) : std::string();
  if (set && doubt.empty()) return {set, RangeSource::set, {}};
  const std::optional<OpRange> inferred = infer_op_range(*values);
  return {inferred, inferred ? RangeSource::inferred : RangeSource::unknown, std::move(doubt)};
}

std::string range_text(const OpRange& range) {
  return number_text(range.low) + " to " + number_text(range.high);
}

}  // namespace loopscope::core::signal
