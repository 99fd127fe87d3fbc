#include "tests/plants/process/plan_maker.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::tests::process {

PlanMaker::PlanMaker(PlantKind kind, double step_s, double settle_s, std::uint64_t seed)
    : random_(seed),
      pace_(random_.log_uniform(0.8, 1.25)),
      rounds_(random_.chance(0.3)),
      moves_(random_.chance(0.05)) {
  plan_.kind = kind;
  plan_.step_s = step_s;
  plan_.settle_s = settle_s;
  plan_.noise_seed = random_.seed();
}

PlantPlan PlanMaker::take() {
  return std::move(plan_);
}

std::size_t PlanMaker::add_upset(double typical, double shortest_memory_s,
                                 double longest_memory_s) {
  UpsetPlan upset;
  upset.typical = typical;
  upset.sd = typical * random_.log_uniform(0.15, 1.0);
  upset.memory_s = random_.log_uniform(shortest_memory_s, longest_memory_s);
  // One in six hardly comes back within the record.
  if (random_.chance(1.0 / 6.0)) upset.memory_s = 10.0 * longest_memory_s;
  upset.smooth = random_.chance(0.5);
  plan_.upsets.push_back(upset);
  return plan_.upsets.size() - 1;
}

std::size_t PlanMaker::add_stream(double nominal, double lag_s, std::optional<std::size_t> supply) {
  StreamPlan stream;
  stream.nominal = nominal;
  stream.full = nominal / random_.uniform(0.35, 0.65);
  stream.hydraulic_lag_s = lag_s * random_.log_uniform(0.7, 1.5);
  stream.supply = supply;
  stream.valve.play = random_.chance(0.5) ? random_.uniform(0.05, 0.3) : 0.0;
  stream.valve.actuator_lag_s = lag_s * random_.log_uniform(0.5, 2.0);
  plan_.streams.push_back(stream);
  return plan_.streams.size() - 1;
}

LoopPlan PlanMaker::basic(const std::string& name, const std::string& type, double nominal,
                          const Sensor& sensor) {
  LoopPlan loop;
  loop.name = name;
  loop.type = type;
  loop.low = sensor.low;
  loop.high = sensor.high;
  loop.sp0 = nominal;
  loop.scan_steps = sensor.scan_steps;
  loop.sensor_lag_s = sensor.lag_s * random_.log_uniform(0.7, 1.4);
  loop.dead_time_s = sensor.dead_time_s * random_.log_uniform(0.7, 1.4);
  const double span = sensor.high - sensor.low;
  loop.noise_sd = 0.01 * span * sensor.noise * random_.log_uniform(0.4, 1.6);
  if (rounds_) loop.quantum = 0.01 * span * random_.log_uniform(0.02, 0.2);
  if (moves_) loop.sp_moves_s = random_.log_uniform(7200.0, 40000.0);
  loop.sp_size = 0.01 * span * random_.uniform(1.0, 3.0);
  return loop;
}

std::size_t PlanMaker::add_flow_loop(const std::string& name, std::size_t stream) {
  const StreamPlan& pipe = plan_.streams[stream];
  LoopPlan loop = basic(name, "flow", pipe.nominal, {.high = pipe.full, .noise = 0.2});
  loop.flow_of = stream;
  loop.valve = stream;
  loop.op0 = 100.0 * pipe.nominal / pipe.full;
  // Flow loops in the field are gentle: little gain, integral action slower than the pipe.
  const double lag_s = pipe.hydraulic_lag_s + pipe.valve.actuator_lag_s;
  loop.gain = random_.log_uniform(0.25, 0.8);
  loop.integral_time_s = std::max(lag_s * random_.log_uniform(1.0, 4.0), 3.0 * plan_.step_s);
  plan_.loops.push_back(loop);
  return plan_.loops.size() - 1;
}

std::size_t PlanMaker::add_loop(const std::string& name, const std::string& type, std::size_t value,
                                double nominal, const Sensor& sensor, const Response& response,
                                std::size_t stream) {
  LoopPlan loop = basic(name, type, nominal, sensor);
  const StreamPlan& pipe = plan_.streams[stream];
  loop.value = value;
  loop.valve = stream;
  loop.op0 = 100.0 * pipe.nominal / pipe.full;
  tune(loop, response, pipe.full / 100.0);
  plan_.loops.push_back(loop);
  return plan_.loops.size() - 1;
}

std::size_t PlanMaker::add_master(const std::string& name, const std::string& type,
                                  std::size_t value, double nominal, const Sensor& sensor,
                                  const Response& response, std::size_t slave) {
  LoopPlan loop = basic(name, type, nominal, sensor);
  LoopPlan& below = plan_.loops[slave];
  loop.value = value;
  loop.op0 = 100.0 * (below.sp0 - below.low) / (below.high - below.low);
  tune(loop, response, (below.high - below.low) / 100.0);
  below.master = plan_.loops.size();
  below.sp_moves_s = 0.0;
  plan_.loops.push_back(loop);
  return plan_.loops.size() - 1;
}

std::size_t PlanMaker::add_level(const std::string& name, std::size_t value, double nominal,
                                 double high, double gain, std::size_t stream,
                                 const std::string& flow_name, bool direct) {
  const Sensor sensor{.high = high, .lag_s = 2.0 * plan_.step_s, .noise = 0.25, .scan_steps = 2};
  const Response response{.gain = gain, .late_s = 10.0 * plan_.step_s};
  if (direct) return add_loop(name, "level", value, nominal, sensor, response, stream);
  const std::size_t slave = add_flow_loop(flow_name, stream);
  return add_master(name, "level", value, nominal, sensor, response, slave);
}

void PlanMaker::set_ratio(std::size_t loop, std::size_t lead) {
  plan_.loops[loop].ratio_to = lead;
  plan_.loops[loop].ratio = plan_.loops[loop].sp0 / plan_.loops[lead].sp0;
  plan_.loops[loop].sp_moves_s = 0.0;
}

void PlanMaker::tune(LoopPlan& loop, const Response& response, double unit_by_percent) {
  const double gain = response.gain * unit_by_percent / (loop.high - loop.low) * 100.0;
  const double late_s = response.late_s + loop.sensor_lag_s + loop.dead_time_s +
                        plan_.step_s * static_cast<double>(loop.scan_steps) / 2.0;
  const double speed = pace_ * random_.log_uniform(0.7, 2.5);
  loop.integrating = response.time_constant_s == 0.0;
  if (loop.integrating) {
    // From tight to averaging: gains of 5.5 to 1.
    const double closed_s = std::max(3.0 * late_s, random_.log_uniform(0.18, 1.0) / std::abs(gain));
    loop.gain = 1.0 / (gain * closed_s);
    loop.integral_time_s = closed_s * random_.uniform(3.0, 6.0);
    return;
  }
  const double closed_s = std::max(speed * late_s, 0.1 * speed * response.time_constant_s);
  loop.gain = response.time_constant_s / (gain * (closed_s + late_s));
  loop.integral_time_s = std::min(response.time_constant_s, 4.0 * (closed_s + late_s));
}

}  // namespace loopscope::tests::process
