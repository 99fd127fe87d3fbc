#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/signal/archive.hpp"

namespace loopscope::core::signal {

/// Whether a window can be judged, and what is odd about it.
struct DataQuality {
  bool usable = false;                ///< for the statistics
  bool enough = false;                ///< long enough, and enough of it recorded
  std::string reason;                 ///< why not usable, in plain words; empty when it is
  std::vector<std::string> flags;     ///< e.g. "short", "sp_missing", "op_range_unknown"
  std::vector<std::string> refusals;  ///< why tests are refused, in plain words
  std::string stretch;  ///< samples that the higher-order statistics see where the record is not
                        ///< stationary, in plain words; empty = all
  std::size_t repeated_times = 0;            ///< rows dropped because a later row had the same time
  std::optional<double> missing_fraction;    ///< of the pv samples, 0 to 1
  std::optional<double> frozen_fraction;     ///< of the pv samples, standing still, 0 to 1
  std::optional<double> drawn_fraction;      ///< of the pv samples, not stored but drawn, 0 to 1
  Archive archive = Archive::complete;       ///< how pv was stored
  std::optional<double> compression_factor;  ///< samples per stored one, gaps left out, >= 1
  std::optional<double> quantisation_factor;  ///< grid step of pv / its standard deviation
  std::optional<double> saturated_fraction;   ///< of op at a limit of its range, 0 to 1
};

}  // namespace loopscope::core::signal
