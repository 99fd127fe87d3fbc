#include "tests/effects/scenario.hpp"

#include <cmath>
#include <utility>

#include "tests/generators/lag.hpp"
#include "tests/generators/pi_controller.hpp"
#include "tests/generators/values.hpp"

namespace loopscope::tests::effects {
namespace {

using generators::Lag;
using generators::lag_share;

double at(const TimeFunction& function, double time, double otherwise) {
  return function ? function(time) : otherwise;
}

/// The flow `delay` samples ago, of a flow that is told once a substep.
class ChangingDelay {
 public:
  double step(double flow, double delay) {
    past_.push_back(flow);
    const auto back = static_cast<std::size_t>(std::lround(delay * kSubsteps));
    return back < past_.size() ? past_[past_.size() - 1 - back] : 0.0;
  }

 private:
  std::vector<double> past_;
};

class ProcessState {
 public:
  explicit ProcessState(const Process& process)
      : process_(&process),
        share_(lag_share(process.tau, kStep)),
        second_(lag_share(process.second_tau, kStep)) {}

  /// Of the same lags.
  void become(const Process& process) { process_ = &process; }

  void step(double flow) {
    if (process_->integrating)
      first_ += kStep * process_->gain / process_->tau * (flow - at(process_->loss, first_, 0.0));
    else
      first_ += share_ * (process_->gain * flow - first_);
    second_.step(first_);
  }
  [[nodiscard]] double pv() const {
    return at(process_->output_curve, second_.value(), second_.value());
  }

 private:
  const Process* process_;
  double share_;
  double first_ = 0.0;
  Lag second_;
};

class Run {
 public:
  /// `next`: what the loop becomes in sample `onset`, nullptr = nothing.
  explicit Run(const Scenario& scenario, const Scenario* next = nullptr, std::size_t onset = 0)
      : s_(&scenario),
        next_(next),
        onset_(onset),
        sp_(next ? next->sp : scenario.sp),
        process_(scenario.process),
        controller_(scenario.op0),
        valve_(scenario.valve ? scenario.valve() : nullptr),
        next_valve_(next && next->valve ? next->valve() : nullptr),
        load_noise_(seed_for("load", scenario.noise_seed)),
        sensor_noise_(seed_for("sensor", scenario.noise_seed)),
        load_volatility_(scenario.noise_family, seed_for("load size", scenario.noise_seed)),
        sensor_volatility_(scenario.noise_family, seed_for("sensor size", scenario.noise_seed)) {}

  Series run() {
    std::size_t start = kRunIn;
    for (std::size_t k = 0; k < sp_.size(); ++k) {
      if (next_ && k == onset_) {
        become_next();
        start = k;
      }
      const double time = static_cast<double>(k) - static_cast<double>(start);
      sense(k, time);
      const double gain = at(s_->controller_gain, time, 1.0) * s_->controller.kc;
      const double op = controller_.step(sp_[k] - pv_, gain, s_->controller.ti);
      const double mv = hold_op(op, time);
      if (k >= kRunIn) record(k, op, mv);
    }
    return std::move(series_);
  }

 private:
  void become_next() {
    s_ = next_;
    process_.become(next_->process);
    valve_ = std::move(next_valve_);
  }

  void sense(std::size_t k, double time) {
    const double reading = s_->noise_sd * sensor_volatility_.next() * sensor_noise_.normal();
    const double noise = s_->load.value(load_) + reading;
    if ((k % static_cast<std::size_t>(s_->hold)) != 0) return;
    const double true_pv =
        process_.pv() + at(s_->output_load, time, 0.0) + at(s_->sensor_bias, time, 0.0);
    pv_ = rounded(true_pv + noise);
    stochastic_ = pv_ - true_pv;
  }

  /// On a grid that starts at 0 % of the span, as a converter's does.
  [[nodiscard]] double rounded(double pv) const {
    if (s_->quantum <= 0.0) return pv;
    return generators::to_grid(pv + s_->pv0, s_->quantum) - s_->pv0;
  }

  double hold_op(double op, double time) {
    double position = op;
    const double loudness = load_volatility_.next();
    for (int i = 0; i < kSubsteps; ++i) {
      const double now = time + i * kStep;
      position = valve_ ? valve_->step(op) : op;
      if (next_valve_) (void)next_valve_->step(op);
      const double flow = s_->trim ? s_->trim(position) : position - s_->op0;
      const double delayed = pipe_.step(flow, at(s_->delay, now, s_->process.delay));
      process_.step(at(s_->process_gain, now, 1.0) * delayed + at(s_->input_load, now, 0.0));
      s_->load.step(load_, loudness * load_noise_.normal());
    }
    return position;
  }

  void record(std::size_t k, double op, double mv) {
    series_.sp.push_back(sp_[k]);
    series_.pv.push_back(pv_);
    series_.op.push_back(op);
    series_.mv.push_back(mv);
    series_.stochastic.push_back(stochastic_);
  }

  const Scenario* s_;
  const Scenario* next_;
  std::size_t onset_;
  const std::vector<double>& sp_;
  ProcessState process_;
  generators::PiController controller_;
  std::unique_ptr<Valve> valve_;
  std::unique_ptr<Valve> next_valve_;
  Random load_noise_;
  Random sensor_noise_;
  Volatility load_volatility_;
  Volatility sensor_volatility_;
  ChangingDelay pipe_;
  Eigen::Vector3d load_ = Eigen::Vector3d::Zero();
  double pv_ = 0.0;
  double stochastic_ = 0.0;
  Series series_;
};

}  // namespace

Series simulate(const Scenario& scenario) {
  return Run(scenario).run();
}

Series simulate_onset(const Scenario& calm, const Scenario& faulty, std::size_t before) {
  return Run(calm, &faulty, kRunIn + before).run();
}

}  // namespace loopscope::tests::effects
