#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/simulate/effect.hpp"

namespace loopscope::core::simulate {

/// The effects of one loop, sorted to the places where a signal meets them. Each function takes
/// the signal's value and the time after the first recorded sample (negative before it), and keeps
/// state: it is called once a sample, in order. Values go in and come out in % of op (valve, flow),
/// % of flow from the operating point (process input, and a load that enters there), pv units from
/// the operating point (process output, other loads) and pv units (measured).
class EffectChain {
 public:
  /// Throws std::invalid_argument for an effect out of range.
  explicit EffectChain(std::span<const Effect> effects);

  double valve_position(double op_percent, double time_s) {
    return run(valve_, op_percent, time_s);
  }
  double flow(double mv_percent, double time_s) { return run(flow_, mv_percent, time_s); }
  double process_input(double flow_offset, double time_s) {
    return run(process_input_, flow_offset, time_s);
  }
  double process_output(double answer, double time_s) {
    return run(process_output_, answer, time_s);
  }
  double load(double wandering, double time_s) { return run(load_, wandering, time_s); }
  double measured(double pv, double time_s) { return run(sensor_, pv, time_s); }

 private:
  using Stage = std::function<double(double value, double time_s)>;
  using Stages = std::vector<Stage>;

  static double run(Stages& stages, double value, double time_s);
  void add(const ValveStiction& stiction);
  void add(const ValveDeadband& deadband);
  void add(const ValveSaturation& saturation);
  void add(const ValveCharacteristic& characteristic);
  void add(const GainChange& change);
  void add(const ProcessNonlinearity& nonlinearity);
  void add(const ExternalOscillation& oscillation);
  void add(const LoadStep& step);
  void add(const SensorHold& hold);
  void add(const SensorQuantisation& quantisation);

  Stages valve_, flow_, process_input_, process_output_, load_, sensor_;
};

}  // namespace loopscope::core::simulate
