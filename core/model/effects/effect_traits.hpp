#pragma once

#include <cstddef>
#include <string_view>

#include "core/model/results/explanation.hpp"

namespace loopscope::core::model {

/// Where an effect acts.
enum class Place {
  valve,    ///< between op and flow: the process has to be searched again behind it
  process,  ///< beside the process's answer, as columns of the fit
  outside,  ///< by time alone, whatever op does
  sensor,   ///< in what is recorded of pv; no part of the model
};

/// Whether the search looks at an effect that no residual test asks for.
enum class CheapLook { never, where_hinted, always };

/// An effect that does not gain so much (n ln) where it was fitted gains nothing on unseen rows.
inline constexpr double kWorthFitting = 8.0;
/// The same where all rows are looked at: less than what a later p of 0.001 asks for.
inline constexpr double kWorthFittingWhole = 11.0;
/// What the search has to know of a kind of effect; each stands in the header of its effect.
struct EffectTraits {
  EffectKind kind = EffectKind::load_step;
  std::string_view word;  ///< that users, scripts and the results schema see
  /// The kind that names its cause: two effects of one cause end in one verdict.
  EffectKind cause = EffectKind::load_step;
  Place place = Place::process;
  std::ptrdiff_t most = 1;  ///< how often it may come
  CheapLook cheap_look = CheapLook::never;
  double worth_fitting = 0.0;  ///< what a first look has to gain (n ln) for a full fit
  /// The first look sees all rows: what a smooth effect gains on the half that a fit would see is
  /// too little to go by, and its few starting points are few tries. So is a line, which has gone
  /// on for all of the record and whose tries count every frequency.
  bool looked_at_whole = false;
  /// Chosen from all places or frequencies: its p counts them, and no part of the record shows its
  /// parameters by itself.
  bool everywhere = false;
  bool on_own_rows = false;   ///< sits in one place: rows about it are seen by fit and score
  bool scored_once = false;   ///< what it gains is counted on one half
  bool put_in_place = false;  ///< the best first looks are moved to where they gain most
  /// A test that asks for it is enough for a full fit as long as the model has none: by a process
  /// that was fitted without it a first look may see nothing of it.
  bool fitted_when_asked = false;
  /// Half of the rows place its parameters.
  bool moves_on_half = true;
};

}  // namespace loopscope::core::model
