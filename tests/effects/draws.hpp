#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/model/results/mechanism.hpp"
#include "tests/effects/outcome.hpp"

namespace loopscope::tests::effects {

/// Seeds `seed` to `seed + draws - 1` of each kind.
struct Plan {
  std::vector<std::string> kinds;
  std::uint64_t seed = 1;
  std::size_t draws = 20;
  unsigned threads = 1;
  Size size = Size::realistic;
  NoiseFamily noise = NoiseFamily::gaussian;
  core::model::Without without{};  ///< parts of the search that are left out
  /// Each loop hears what the residual tests say of a loop of the next kind but one.
  bool permuted = false;
};

/// Per kind of the plan, one outcome per draw; the same for any number of threads except for the
/// milliseconds. Throws what a draw throws.
[[nodiscard]] std::vector<std::vector<Outcome>> run_draws(const Plan& plan);

}  // namespace loopscope::tests::effects
