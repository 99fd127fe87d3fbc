#pragma once

namespace loopscope::core::simulate {

/// A stem that cannot travel the whole way (stop, blocked bypass, weak actuator):
/// mv = min(max(mv, low), high).
struct ValveSaturation {
  double low_percent = 0.0;
  double high_percent = 100.0;  ///< > low, both 0 to 100
};

/// Flow that is not proportional to travel (wear, corroded seat, wrong trim):
/// flow = mv + c (mv - 50)^2 / 50, all in %. The slope runs from 1 - 2c at 0 % to 1 + 2c at 100 %.
struct ValveCharacteristic {
  double curvature = 0.3;  ///< c, -0.5 to 0.5: beyond that the flow would turn back
};

/// Throws std::invalid_argument unless 0 <= low < high <= 100.
void check(const ValveSaturation& saturation);
/// Throws std::invalid_argument for a curvature outside -0.5 to 0.5.
void check(const ValveCharacteristic& characteristic);

[[nodiscard]] double limited_travel(const ValveSaturation& saturation, double position_percent);
[[nodiscard]] double flow_at(const ValveCharacteristic& characteristic, double position_percent);

}  // namespace loopscope::core::simulate
