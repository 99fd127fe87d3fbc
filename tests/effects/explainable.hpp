#pragma once

#include "tests/effects/scenario.hpp"

namespace loopscope::tests::effects {

/// A record beside the loop that its effects were put into.
struct Recorded {
  const Scenario& base;      ///< without effects: its process is the linear one
  const Scenario& scenario;  ///< with them: its noise is the record's
  const Series& series;
};

/// What the effects add to the one-step error of a linear model, by the floor that load and noise
/// really have in this record: 0 = nothing. The linear model knows the process and the noise of the
/// loop; least squares on the one-step innovations fits gain, a shift in time, the working point
/// and a noise model of high order. Fitting them costs it less than 0.01.
[[nodiscard]] double explainable(const Recorded& record);

/// Mean square of the one-step innovations of load and sensor noise when all else is known. A held
/// value is foreseen without error except when it is renewed; rounding is white noise of a twelfth
/// of the squared step.
[[nodiscard]] double floor_of(const Scenario& scenario);

/// The same as it came out in this record.
[[nodiscard]] double realised_floor(const Scenario& scenario, const Series& series);

}  // namespace loopscope::tests::effects
