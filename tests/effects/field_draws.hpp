#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/effects/draws.hpp"

namespace loopscope::tests::effects {

/// What the diagnosis says of a record about which only this is known: whether the valve sticks.
struct FieldOutcome {
  std::string kind;        ///< family, or the recording's label
  std::uint64_t seed = 0;  ///< of a recording its place in the list
  std::string verdict;
  double confidence = 0.0;
  bool sticks = false;
  bool accuses_valve = false;  ///< valve_stiction or valve_deadband
  double milliseconds = 0.0;
};

/// Plan::draws records of every family of tests/core/model/field_families.
[[nodiscard]] std::vector<FieldOutcome> field_draws(const Plan& plan);

/// The recordings of a manifest that are labelled as sticking or not.
/// @throws WrongUsage a file cannot be read, or there are none
[[nodiscard]] std::vector<FieldOutcome> recorded(const Plan& plan, const std::string& manifest);

/// A line of JSON for each.
[[nodiscard]] std::string lines_of(const std::vector<FieldOutcome>& outcomes);

}  // namespace loopscope::tests::effects
