#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/plant/member_loop.hpp"
#include "tests/plants/network/network.hpp"

namespace loopscope::tests::network {

/// One loop of a plant as the service knows it: what its own window says.
struct DiagnosedLoop {
  std::string name;
  double interval_s = 1.0;
  std::int64_t start_us = 0;
  std::vector<double> error, sp, pv, op;
  core::plant::OwnFindings own;
  // Published criteria, to compare with (criteria.hpp).
  std::optional<double> nonlinear_p, cubic_p;
  double valve_explained = 0.0;  ///< ln(error before / after) of sticking or play, held out
  std::string verdict;
  double ngi = 0.0;
};

/// core's diagnosis of every record, with a loop model where the statistics give cause for one, as
/// the service does it.
[[nodiscard]] DiagnosedLoop diagnose(const LoopRecord& record, const TrueLoop& truth,
                                     std::uint64_t seed);

/// Views of `loops`, which have to outlive them.
[[nodiscard]] std::vector<core::plant::MemberLoop> members_of(
    const std::vector<DiagnosedLoop>& loops);

}  // namespace loopscope::tests::network
