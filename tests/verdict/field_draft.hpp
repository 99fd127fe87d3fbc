#pragma once

#include <cstddef>
#include <string>

#include "tests/core/model/field_loop.hpp"
#include "tests/verdict/labelled.hpp"

namespace loopscope::tests::verdict {

/// A loop in the making: what runs, for how long, and what is wrong with it.
struct FieldDraft {
  model::FieldSettings settings;
  std::size_t samples = 4096;
  double swing_pv = 0.0;  ///< standard deviations of the loop so far, pv units
  double swing_op = 0.0;  ///< %
  Truth truth;
};

/// Fills in the swing by a run of so many samples.
void measure_swing(FieldDraft& draft, std::size_t samples, model::Draw& draw);

[[nodiscard]] SimulatedLoop run_draft(const FieldDraft& draft, const std::string& family,
                                      model::Draw& draw);

}  // namespace loopscope::tests::verdict
