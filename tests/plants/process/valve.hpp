#pragma once

#include "tests/plants/process/plan.hpp"

namespace loopscope::tests::process {

/// Actuator and stem of one valve, in % of travel, one step at a time.
class Valve {
 public:
  Valve(const ValvePlan& plan, double step_s, double position);
  double step(double op);

 private:
  void follow_with_play();
  void jump();
  void slide();

  ValvePlan plan_;
  double fresh_;        ///< of the actuator's way in a step
  double slide_fresh_;  ///< of the stem's
  double actuator_;
  double before_;
  double stem_;
  double held_ = 0.0;  ///< of the two-parameter law: force that friction takes up
  bool moving_ = false;
};

}  // namespace loopscope::tests::process
