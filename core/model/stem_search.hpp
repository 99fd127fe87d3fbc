#pragma once

#include "core/model/hysteresis_net.hpp"
#include "core/model/valve_law.hpp"

namespace loopscope::core::model {

/// The valve of law `he` or `kano` that is looked at between the samples
/// (valve_between_samples.hpp) with which op explains pv best, about a valve of that band, and the
/// process behind it.
///
/// Such a valve keeps an error of its position until the next one, so that over the whole record
/// the right one is a needle in eight dimensions. Over a few hundred samples it is a hill: guesses
/// that fill the room are ranked there, the best ones have children, and while those that are left
/// are looked at over longer and longer beginnings of the record they come closer to each other.
///
/// `behind` ends with a valve; its process and noise are where the search begins. The same data
/// give the same result.
[[nodiscard]] NetFind find_stem(const LoopData& data, const Structure& behind, double band,
                                ValveLaw law);

/// Guesses that one search looks at, about: what it finds has been chosen from these.
inline constexpr std::size_t kStemGuesses = 12000;

}  // namespace loopscope::core::model
