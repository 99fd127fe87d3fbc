#pragma once

#include <optional>
#include <string>

#include "tests/plants/process/plan.hpp"
#include "tests/plants/process/random.hpp"

namespace loopscope::tests::process {

/// What a loop's value does about the nominal state when its stream (or its slave's setpoint)
/// moves by one unit, the other loops at rest.
struct Response {
  double gain = 1.0;             ///< per unit; integrating: a second and unit
  double time_constant_s = 0.0;  ///< of what is not integrating
  double late_s = 5.0;           ///< dead time and small lags, in the loop's path
};

/// How a loop measures; sizes in % of its span.
struct Sensor {
  double low = 0.0, high = 100.0;
  double lag_s = 0.0, dead_time_s = 0.0;
  double noise = 0.2;  ///< usual standard deviation
  long scan_steps = 1;
};

/// Puts a plan together: streams, and loops tuned by rule and lot. Flow and self-regulating loops
/// by SIMC (Skogestad 2003), a speed factor drawn; vessels from averaging to tight.
class PlanMaker {
 public:
  PlanMaker(PlantKind kind, double step_s, double settle_s, std::uint64_t seed);

  Random& random() { return random_; }
  PlantPlan& plan() { return plan_; }
  PlantPlan take();

  std::size_t add_upset(double typical, double shortest_memory_s, double longest_memory_s);
  /// Valve at 35 to 65 %. `lag_s` = of the pipe.
  std::size_t add_stream(double nominal, double lag_s, std::optional<std::size_t> supply);
  std::size_t add_flow_loop(const std::string& name, std::size_t stream);
  /// On the valve of `stream`.
  std::size_t add_loop(const std::string& name, const std::string& type, std::size_t value,
                       double nominal, const Sensor& sensor, const Response& response,
                       std::size_t stream);
  /// On the setpoint of a loop that is there.
  std::size_t add_master(const std::string& name, const std::string& type, std::size_t value,
                         double nominal, const Sensor& sensor, const Response& response,
                         std::size_t slave);
  /// A level on a flow loop, or with `direct` on its valve.
  std::size_t add_level(const std::string& name, std::size_t value, double nominal, double high,
                        double gain, std::size_t stream, const std::string& flow_name, bool direct);
  void set_ratio(std::size_t loop, std::size_t lead);

 private:
  LoopPlan basic(const std::string& name, const std::string& type, double nominal,
                 const Sensor& sensor);
  void tune(LoopPlan& loop, const Response& response, double unit_by_percent);

  Random random_;
  PlantPlan plan_;
  double pace_;  ///< of the whole plant's tuning
  bool rounds_, moves_;
};

}  // namespace loopscope::tests::process
