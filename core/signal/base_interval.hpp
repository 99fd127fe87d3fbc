#pragma once

#include "core/signal/raw_series.hpp"

namespace loopscope::core::signal {

/// The interval at which the tag was scanned, in seconds; 0 when no two rows differ in time.
///
/// usual_interval_s() where the rows lie at it. An archive that leaves rows out, or stamps that
/// jitter, make that a multiple of the scan interval or an inaccurate one: then the longest
/// interval of which the spacings are multiples, no shorter than an eighth of the usual one, found
/// by how well the spacings agree in phase with it and refined over all of them.
[[nodiscard]] double base_interval_s(const RawSeries& rows);

}  // namespace loopscope::core::signal
