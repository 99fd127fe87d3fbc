#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::signal {

/// Where the range of op comes from.
enum class RangeSource {
  unknown,   ///< op keeps its own units
  inferred,  ///< from its values alone
  set,       ///< by a person, in the catalogue or as an option
};

/// The range that turns op into percent.
struct KnownRange {
  std::optional<OpRange> range;  ///< nullopt = unknown
  RangeSource source = RangeSource::unknown;
  /// Of a range that was set and does not fit the values: why, in plain words ("op never leaves 0
  /// to 1 of 0 to 100"). The range is inferred then. Empty = no doubt.
  std::string doubt;
};

/// Values of op over a time, for inferring its range.
struct OpValues {
  double low = 0.0;  ///< smallest and largest one, but for one in five hundred at either end
  double high = 0.0;
  bool whole = false;  ///< all of them are whole numbers
  bool at_20_ma =
      false;  ///< held at exactly 4 or 20, all the others, if any, being no whole numbers
};
/// `op` in its own units, NaN = missing; nullopt when nothing is recorded.
[[nodiscard]] std::optional<OpValues> summarise_op(std::span<const double> op);

/// The usual ranges, the narrowest that fits: 0 to 1; 4 to 20 (mA) where the values cover most of
/// it and never leave it, or rest at its ends; 0 to 100, with the few percent beyond that
/// controllers allow; the full scales of converters for whole numbers above. nullopt = none fits.
[[nodiscard]] std::optional<OpRange> infer_op_range(const OpValues& values);

/// What was set, unless the values contradict it; else what can be inferred. `op` as above.
[[nodiscard]] KnownRange find_op_range(std::span<const double> op,
                                       const std::optional<OpRange>& set);

/// "0 to 100".
[[nodiscard]] std::string range_text(const OpRange& range);

}  // namespace loopscope::core::signal
