#pragma once

#include "tests/effects/draft.hpp"

namespace loopscope::tests::effects {

/// Each puts one effect into the scenario of a draft and its truth, conditions and measurements
/// beside it.
using Dress = void (*)(Draft& draft, Random& random);

void add_stiction(Draft& draft, Random& random);
void add_deadband(Draft& draft, Random& random);
void add_saturation(Draft& draft, Random& random);
void add_characteristic(Draft& draft, Random& random);
void add_process_nonlinearity(Draft& draft, Random& random);
void add_oscillation(Draft& draft, Random& random);
void add_load_steps(Draft& draft, Random& random);
void add_gain_change(Draft& draft, Random& random);
void add_quantisation(Draft& draft, Random& random);
void add_hold(Draft& draft, Random& random);

/// What no effect of the catalogue describes; these leave no TrueEffect.
void add_intermittent_stiction(Draft& draft, Random& random);
void add_hunting_positioner(Draft& draft, Random& random);
void add_delay_change(Draft& draft, Random& random);
void add_nonlinear_neighbour(Draft& draft, Random& random);
void add_controller_change(Draft& draft, Random& random);
void add_overflow_weir(Draft& draft, Random& random);
void add_sensor_drift(Draft& draft, Random& random);

/// Of pv's noise variance: the controller hides most of a bend or a change of gain.
inline constexpr double kLeastBend = 0.05;

/// The record with the effect differs from that without by at least `share` of pv's noise
/// variance.
void require_visible(Draft& draft, double share);

}  // namespace loopscope::tests::effects
