#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/plants/network/draw_plan.hpp"
#include "tests/plants/network/simulate.hpp"

namespace loopscope::tests::network {

/// What is true of one loop.
struct TrueLoop {
  std::string name;
  LoopKind kind = LoopKind::flow;
  double share = 0.0;      ///< of the error's variance that the cause brings
  bool carries = false;    ///< at least kCarries of it, and sampled so that its period can be seen
  bool unrelated = false;  ///< has an oscillation of its own
  bool sticks = false;     ///< which a valve of its own makes
};

/// Share of the error's variance from which a loop carries the oscillation, and below which it is
/// untouched; between the two either answer is right.
inline constexpr double kCarries = 0.25;
inline constexpr double kUntouched = 0.02;

struct NetworkPlant {
  std::vector<LoopRecord> records;
  std::vector<TrueLoop> loops;
  std::optional<std::size_t> source;                          ///< nullopt = the cause is outside
  std::vector<std::pair<std::size_t, std::size_t>> cascades;  ///< master, slave
  double period_s = 0.0;                                      ///< of the source's error
};

/// A plant of thirty loops in which a cause shakes the source and at least three more loops that
/// can be seen. The same for the same seed; drafts in which it does not are thrown away.
[[nodiscard]] NetworkPlant draw_network(std::uint64_t seed, Origin origin);

}  // namespace loopscope::tests::network
