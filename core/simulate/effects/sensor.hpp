#pragma once

namespace loopscope::core::simulate {

/// A sensor or converter with too few bits: pv = q round(pv / q).
struct SensorQuantisation {
  double step = 1.0;  ///< q, pv units, > 0
};

/// A sensor that renews its value only every so many samples (analyser, slow transmitter).
struct SensorHold {
  double samples = 10.0;  ///< whole number, 1 to 10000; 1 = every sample
};

/// Throw std::invalid_argument for figures outside their ranges.
void check(const SensorQuantisation& quantisation);
void check(const SensorHold& hold);

[[nodiscard]] double quantised(const SensorQuantisation& quantisation, double pv);

/// One sensor that holds; renews at its first sample and every `samples` after that.
class HoldingSensor {
 public:
  /// Throws as check().
  explicit HoldingSensor(const SensorHold& hold);

  /// What is recorded at the next sample, in pv's unit.
  double next(double pv);

 private:
  long period_ = 0;
  long age_ = 0;
  double held_ = 0.0;
};

}  // namespace loopscope::core::simulate
