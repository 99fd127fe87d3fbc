#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "tests/effects/load_model.hpp"
#include "tests/effects/noise_family.hpp"
#include "tests/effects/valve.hpp"

namespace loopscope::tests::effects {

inline constexpr std::size_t kSamples = 4096;  ///< of a record
inline constexpr double kEnd = static_cast<double>(kSamples);
inline constexpr std::size_t kRunIn = 1000;  ///< samples before it, thrown away

/// Of the time in samples, 0 = the first recorded sample.
using TimeFunction = std::function<double(double)>;
using Curve = std::function<double(double)>;

/// What lies between the flow through the valve and the sensor; times in samples, pv in % of span.
struct Process {
  bool integrating = false;
  double gain = 1.0;        ///< pv by flow; integrating: pv per sample and flow, times `tau`
  double tau = 10.0;        ///< of the first lag or of the vessel
  double second_tau = 0.0;  ///< 0 = none
  double delay = 2.5;
  Curve loss = {};          ///< integrating: flow that leaves at this level; empty = none
  Curve output_curve = {};  ///< of what the lags give; empty = straight
};

/// op(k) = op(k-1) + kc (e(k) - e(k-1) + e(k) / ti), held to 0 to 100 %.
struct Controller {
  double kc = 1.0;
  double ti = 10.0;  ///< samples
};

/// One closed loop in full: everything is a distance from (op0, pv0) except op and the valve.
struct Scenario {
  Process process;
  Controller controller;
  double op0 = 50.0;
  double pv0 = 50.0;
  LoadModel load;
  double noise_sd = 0.0;  ///< of the white measurement noise
  std::uint64_t noise_seed = 0;
  NoiseFamily noise_family = NoiseFamily::gaussian;  ///< of load and measurement
  std::vector<double> sp;  ///< kRunIn values and one for each sample of the record
  std::function<std::unique_ptr<Valve>()> valve;  ///< empty = follows at once
  Curve trim;                                     ///< stem position to flow; empty = position - op0
  TimeFunction process_gain;                      ///< factor; this and the next: empty = nothing
  TimeFunction delay;                             ///< samples, instead of the process's
  TimeFunction controller_gain;                   ///< factor
  TimeFunction input_load;                        ///< joins the flow
  TimeFunction output_load;                       ///< joins the pv
  TimeFunction sensor_bias;
  int hold = 1;          ///< the sensor renews its value every so many samples
  double quantum = 0.0;  ///< it rounds to multiples of this; 0 = it does not
};

/// One value per sample of the record; op, mv in %, the others as in Scenario.
struct Series {
  std::vector<double> sp;
  std::vector<double> pv;
  std::vector<double> op;
  std::vector<double> mv;          ///< the stem at the end of the sample over which op is held
  std::vector<double> stochastic;  ///< what load, noise and rounding add to the sensor's value
};

/// Runs the loop with kSubsteps steps a sample; op is held over a sample.
[[nodiscard]] Series simulate(const Scenario& scenario);

/// The same of a loop that is `calm` for the run-in and `before` samples and `faulty` from then on,
/// whose set point it has all the time. Process, controller, load and noise go on from one sample
/// to the next; the valve of `faulty` has followed op since the start, its times count from the
/// onset.
[[nodiscard]] Series simulate_onset(const Scenario& calm, const Scenario& faulty,
                                    std::size_t before);

}  // namespace loopscope::tests::effects
