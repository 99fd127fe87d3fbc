#include "daemon/lab/reproduce/industrial_case.hpp"

namespace loopscope::daemon {

const std::vector<IndustrialCase>& industrial_cases() {
  static const std::vector<IndustrialCase> cases = {
      {"6.1", "dryer temperature loop", 0.006, 0.197, "backlash and stiction of the valve",
       "verdicts valve_stiction and valve_deadband, from the wave shape, the pv-op ellipse and, "
       "where recorded, mv against op; `simulate sticking_valve` and `simulate deadband`"},
      {"6.2.1", "recycle flow, before the repair", 0.01, 0.10,
       "oversized valve (op moves between 49.4 and 50 only)",
       "verdict valve_oversized, from the large pv response to tiny moves of op; "
       "`simulate oversized_valve`"},
      {"6.2.1", "recycle flow, valve replaced", 0.0005, 0.05, "none left",
       "the NLI of 0.05 counts for nothing once NGI is below 0.001; before and after are set side "
       "by side in the view before_after_maintenance"},
      {"6.2.2", "pump outlet flow, before the repair", 0.032, 0.13, "corroded valve seat and plug",
       "a curved valve (effect valve_characteristic, `simulate worn_valve`); from the statistics "
       "alone the verdict is nonlinear_unexplained, since only a model of the loop can name it"},
      {"6.2.2", "pump outlet flow, valve replaced", 0.04, 0.06,
       "unknown nonlinearity in a reduced form (the paper's words, by NLI: NGI rose)",
       "verdict nonlinear_unexplained says that structure is left and claims no cause"},
  };
  return cases;
}

}  // namespace loopscope::daemon
