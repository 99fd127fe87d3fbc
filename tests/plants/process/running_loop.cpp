#include "tests/plants/process/running_loop.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::tests::process {
namespace {

constexpr double kRatioFilter_s = 10.0;  // of the flow that a ratio is taken of

}  // namespace

RunningLoop::RunningLoop(const LoopPlan& plan, double step_s, std::uint64_t seed, Window window,
                         long first)
    : plan_(plan),
      step_s_(step_s),
      scan_s_(step_s * static_cast<double>(plan.scan_steps)),
      noise_(seed_of_part(seed, 1)),
      moves_(seed_of_part(seed, 2)),
      sawtooth_(plan.sawtooth, step_s, seed_of_part(seed, 3)),
      window_(window),
      first_(first),
      lag_fresh_(plan.sensor_lag_s > 0.0 ? 1.0 - std::exp(-step_s / plan.sensor_lag_s) : 1.0),
      pipe_(static_cast<std::size_t>(std::lround(plan.dead_time_s / step_s)), plan.sp0),
      lagged_(plan.sp0),
      pv_(plan.sp0),
      sp_(plan.sp0),
      op_(plan.op0),
      integral_(plan.op0),
      smoothed_(plan.sp0) {
  record_.interval_s = step_s * static_cast<double>(window.every);
  record_.start_s = step_s * static_cast<double>(first);
}

void RunningLoop::scan(long step, double value, std::optional<double> told) {
  const double sensed = sense(value);
  if (step % plan_.scan_steps != 0) return;
  pv_ = sensed + (plan_.noise_sd > 0.0 ? plan_.noise_sd * noise_.normal() : 0.0);
  if (plan_.quantum > 0.0) pv_ = plan_.quantum * std::round(pv_ / plan_.quantum);
  out_of_span_ =
      out_of_span_ || !(pv_ > plan_.low - 0.02 * (plan_.high - plan_.low)) || pv_ > plan_.high;
  smoothed_ += std::min(1.0, scan_s_ / kRatioFilter_s) * (pv_ - smoothed_);
  move_setpoint();
  if (told) sp_ = *told;
  control();
}

double RunningLoop::sense(double value) {
  if (!pipe_.empty()) {
    std::swap(value, pipe_[pipe_at_]);
    pipe_at_ = (pipe_at_ + 1) % pipe_.size();
  }
  lagged_ += lag_fresh_ * (value - lagged_);
  return lagged_ + sawtooth_.step();
}

void RunningLoop::move_setpoint() {
  if (plan_.sp_moves_s > 0.0 && moves_.chance(scan_s_ / plan_.sp_moves_s))
    sp_ = plan_.sp0 + plan_.sp_size * moves_.uniform(-1.0, 1.0);
}

/// PI whose integral stops where the output does.
void RunningLoop::control() {
  const double error = 100.0 * (sp_ - pv_) / (plan_.high - plan_.low);
  const double rise = plan_.gain * error * scan_s_ / plan_.integral_time_s;
  const double wanted = integral_ + rise + plan_.gain * error;
  op_ = std::clamp(wanted, plan_.op_low, plan_.op_high);
  if (wanted == op_ || (wanted - op_) * rise < 0.0) integral_ += rise;
}

double RunningLoop::op_as_setpoint(const LoopPlan& slave) const {
  return slave.low + op_ / 100.0 * (slave.high - slave.low);
}

void RunningLoop::record(long step) {
  if (step < first_ || record_.pv.size() >= window_.samples) return;
  if ((step - first_) % window_.every != 0) return;
  record_.sp.push_back(sp_);
  record_.pv.push_back(pv_);
  record_.op.push_back(op_);
}

}  // namespace loopscope::tests::process
