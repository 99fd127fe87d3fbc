#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/loop/unit_match.hpp"
#include "tests/core/loop/signals.hpp"

/// Loops as setpoint and pv show them, of transmitters of nine ranges: setpoints with one to three
/// decimals; a loop of 3 to 60 samples, a load and noise of 0.01 to 2 % of the range.
namespace loopscope::core::loop::signals {

enum class Setpoint { rests, steps, cascade };
inline constexpr std::array kSetpoints{Setpoint::rests, Setpoint::steps, Setpoint::cascade};
[[nodiscard]] std::string_view name(Setpoint kind);

/// Why pv is not at its setpoint, with units that are the same.
enum class Elsewhere {
  nothing,       ///< it is: a sound loop
  proportional,  ///< a controller without integral action, 30 to 95 % of the way
  held,          ///< at a limit: pv anywhere in the range
  manual,        ///< the same, and pv wanders
  bias,          ///< pv is 2 to 50 % of the range off
};
inline constexpr std::array kElsewhere{Elsewhere::nothing, Elsewhere::proportional, Elsewhere::held,
                                       Elsewhere::manual, Elsewhere::bias};
[[nodiscard]] std::string_view name(Elsewhere why);

struct UnitLoop {
  Series sp, pv;
};
[[nodiscard]] UnitLoop loop_elsewhere(Random& random, Setpoint kind, Elsewhere why);

/// A sound loop whose setpoint is recorded so that `conversion` gives it in pv's unit; of
/// temperatures where the conversion has an offset.
[[nodiscard]] UnitLoop loop_in_units(Random& random, Setpoint kind,
                                     const UnitConversion& conversion);

/// The mean error is above five of its standard deviations: the flag `sp_not_followed`.
[[nodiscard]] bool is_far(const UnitLoop& loop);

/// Of `records` loops of either kind, shares.
struct UnitShares {
  double far = 0.0;      ///< is_far()
  double doubted = 0.0;  ///< is_far(), and units likelier than not; of the conversion where one is
  double shown = 0.0;    ///< and followed, with a probability of 0.99
  double wrong = 0.0;    ///< another conversion is likelier than not
};
[[nodiscard]] UnitShares shares_elsewhere(Setpoint kind, Elsewhere why, std::size_t records,
                                          std::uint64_t seed);
[[nodiscard]] UnitShares shares_in_units(Setpoint kind, const UnitConversion& conversion,
                                         std::size_t records, std::uint64_t seed);

}  // namespace loopscope::core::loop::signals
