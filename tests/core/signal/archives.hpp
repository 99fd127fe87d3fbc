#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/signal/loop_window.hpp"

namespace loopscope::core::signal {

/// Places of the samples that an archive keeps.
using Kept = std::vector<std::size_t>;

/// Exception reporting: kept when it differs from the one kept last by more than `band`.
[[nodiscard]] Kept keep_dead_band(const Samples& samples, double band);

/// Swinging door: kept when the next one cannot be reached by a line that stays within `band` of
/// all samples since the one kept last.
[[nodiscard]] Kept keep_swinging_door(const Samples& samples, double band);

/// The same with doors that only open, hinged `band` above and below the sample kept last.
[[nodiscard]] Kept keep_opening_doors(const Samples& samples, double band);

/// The samples that `keep` keeps with the band that leaves one in `factor`.
[[nodiscard]] Kept keep_one_in(double factor, const Samples& samples,
                               const std::function<Kept(const Samples&, double)>& keep);

[[nodiscard]] Samples only(const Samples& samples, const Kept& kept);           ///< others NaN
[[nodiscard]] Samples held_between(const Samples& samples, const Kept& kept);   ///< steps
[[nodiscard]] Samples lines_between(const Samples& samples, const Kept& kept);  ///< lines

}  // namespace loopscope::core::signal
