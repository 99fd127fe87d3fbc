#include "tests/plants/fault_kinds.hpp"

namespace loopscope::tests::plants {

std::span<const FaultKind> fault_kinds() {
  static const std::vector<FaultKind> kKinds = {
      {"valve_stiction", {"valve_stiction"}},
      {"valve_deadband", {"valve_deadband"}},
      {"valve_saturation", {"valve_saturation"}},
      {"valve_characteristic", {"valve_characteristic"}},
      {"process_nonlinearity", {"process_nonlinearity"}},
      // A load step is an event of one afternoon, no fault that lasts.
      {"external_disturbance", {"external_oscillation"}},
      {"sensor_fault", {"sensor_quantisation", "sensor_hold"}},
      {"tight_tuning", {"tight", "tight_moving"}},
  };
  return kKinds;
}

}  // namespace loopscope::tests::plants
