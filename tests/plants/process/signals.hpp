#pragma once

#include "tests/plants/process/plan.hpp"
#include "tests/plants/process/random.hpp"

namespace loopscope::tests::process {

/// Noise through one or two first-order filters, of unit standard deviation.
class FilteredNoise {
 public:
  FilteredNoise(double memory_s, bool twice, double step_s, std::uint64_t seed);
  double step();

 private:
  double keep_;
  double fresh_;
  bool twice_;
  double scale_;
  double first_ = 0.0;
  double second_ = 0.0;
  Random random_;
};

/// A supply in time: its own noise, and the wave if it has one, which draws from a seed of its own
/// so that the rest is the same without it.
class Upset {
 public:
  Upset(const UpsetPlan& plan, double step_s, std::uint64_t seed);
  double step();

 private:
  double wave();

  UpsetPlan plan_;
  double step_s_;
  FilteredNoise noise_;
  FilteredNoise swell_;
  Random wander_;
  double phase_ = 0.0;
};

/// The drift of a sensor that is set right again and again, about zero.
class Sawtooth {
 public:
  Sawtooth(const SawtoothPlan& plan, double step_s, std::uint64_t seed);
  double step();

 private:
  void begin();

  SawtoothPlan plan_;
  double step_s_;
  Random random_;
  double length_s_ = 1.0;
  double height_ = 0.0;
  double age_s_ = 0.0;
};

}  // namespace loopscope::tests::process
