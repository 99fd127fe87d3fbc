#include "core/simulate/effects/valve_travel.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace loopscope::core::simulate {

void check(const ValveSaturation& saturation) {
  const bool ordered = saturation.low_percent < saturation.high_percent;
  if (!(ordered && saturation.low_percent >= 0.0 && saturation.high_percent <= 100.0)) {
    throw std::invalid_argument("valve_saturation: 0 <= low < high <= 100 does not hold");
  }
}

void check(const ValveCharacteristic& characteristic) {
  if (!(std::abs(characteristic.curvature) <= 0.5)) {
    throw std::invalid_argument("valve_characteristic: curvature outside -0.5 to 0.5");
  }
}

double limited_travel(const ValveSaturation& saturation, double position_percent) {
  return std::clamp(position_percent, saturation.low_percent, saturation.high_percent);
}

double flow_at(const ValveCharacteristic& characteristic, double position_percent) {
  const double offset = position_percent - 50.0;
  return position_percent + characteristic.curvature * offset * offset / 50.0;
}

}  // namespace loopscope::core::simulate
