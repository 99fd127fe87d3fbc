#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/plant/shared_oscillation.hpp"

namespace loopscope::core::plant {

/// Loops that are compared pair by pair at most; those beyond the strongest eight follow.
inline constexpr std::size_t kMostLeading = 8;

/// Whose past foretells whose future, of loops that share an oscillation (Granger 1969): pv (the
/// error where none was recorded) and op on a grid of an eighth of the period, or of the coarsest
/// sampling; forecasts of a loop's pv from half a period of its own pv and op with and without the
/// other loop's, gain = ln(variance of the one-step error without / with), less what a loop that
/// knows nothing adds (its coefficients by the count of rows). The op matters: what a controller
/// did foretells what its own loop does next, and only the rest has to come from elsewhere.
/// Two of one plant foretell each other in part: what matters is which way more goes. `direct` is
/// the same with all other members' pasts known (Geweke 1984): it leaves out what goes by way of
/// them. Strongest first; empty where fewer than six rows a coefficient are recorded by all.
/// `members` = indices into `loops`; those beyond kMostLeading are left out, and so are those of
/// which little is recorded beside the others.
[[nodiscard]] std::vector<Lead> find_leads(std::span<const MemberLoop> loops,
                                           std::span<const std::size_t> members, double period_s);

/// What goes out of a loop and what comes in, over all pairs: (out - in) / (out + in + 0.02) of
/// `part`, within -1 to 1; 0 for one that was not compared.
[[nodiscard]] double net_lead(std::span<const Lead> leads, std::size_t loop,
                              double Lead::*part = &Lead::gain);

}  // namespace loopscope::core::plant
