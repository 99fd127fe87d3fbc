#pragma once

#include "core/model/valve_law/valve_law.hpp"
#include "core/model/valve_search/hysteresis_grid_search.hpp"

namespace loopscope::core::model {

/// Whether nothing but the valve that it ends with changes what the loop makes of op. Another
/// effect within the loop would have to follow each guess anew, which takes seconds; in 2100 drawn
/// loops such a search led to nothing but one play that was not there.
[[nodiscard]] bool can_seek_sticking(const Structure& behind);

/// The valve of law `he` or `kano` that is looked at between the samples
/// (valve_between_samples.hpp) with which op explains pv best, about a valve of that band, and the
/// process behind it.
///
/// Such a valve keeps an error of its position until the next one, so that over the whole record
/// the right one is a very narrow minimum of the error in nine dimensions. Over a few hundred
/// samples the minimum is wide: guesses that fill the room evenly are ranked there, and the best
/// ones have children by differential evolution (Storn and Price 1997): they lie along what other
/// guesses differ by, which is as long and as slanted as the minimum. Those that are left are
/// looked at over longer and longer beginnings of the record. Where the best of them hardly jump
/// halfway, the valve has play, and no more of them are tried.
///
/// `band` in % of op. `behind` ends with a valve (can_seek_sticking()); its process and noise are
/// where the search begins. Each `attempt` has first guesses of its own. The same data give the
/// same result. Where the guesses stay far behind `rival`, which ends with a valve too, the search
/// is given up: a fit_error of infinity.
[[nodiscard]] GridResult find_stem(const LoopData& data, const Structure& behind, double band,
                                   ValveLaw law, std::size_t attempt = 0,
                                   const Structure* rival = nullptr);

/// Guesses that the searches for one valve look at, about: by both laws and in three closer looks
/// (refine_valve()) 9000 each. What they find has been chosen from these.
inline constexpr std::size_t kStemGuesses = 45000;

}  // namespace loopscope::core::model
