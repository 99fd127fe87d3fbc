#include "tests/plants/network/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/effects/random.hpp"
#include "tests/generators/pi_controller.hpp"
#include "tests/generators/values.hpp"

namespace loopscope::tests::network {
namespace {

using effects::Random;

/// Fifteen minutes for what is fast, and six of its longest time constants for what is slow.
double run_in_s(const PlantPlan& plan) {
  double longest = 0.0;
  for (const LoopPlan& loop : plan.loops)
    longest = std::max({longest, loop.process.time_constant_s, loop.controller.integral_time_s});
  return 900.0 + 6.0 * longest;
}

double last_sample_s(const PlantPlan& plan, std::size_t samples) {
  double longest = 0.0;
  for (const LoopPlan& loop : plan.loops) longest = std::max(longest, loop.interval_s);
  return run_in_s(plan) + longest * static_cast<double>(samples);
}

/// One loop in time.
class RunningLoop {
 public:
  RunningLoop(const LoopPlan& plan, std::uint64_t seed, double end_s, std::size_t samples)
      : plan_(plan),
        samples_(samples),
        random_(seed),
        process_(plan.process, kStep_s),
        controller_(plan.op0),
        keep_(std::exp(-plan.controller.scan_s / plan.load_tau_s)),
        fresh_(plan.load_sd * std::sqrt(1.0 - keep_ * keep_)),
        valve_(plan.valve ? plan.valve() : nullptr),
        steps_a_scan_(std::lround(plan.controller.scan_s / kStep_s)),
        steps_a_sample_(std::lround(plan.interval_s / kStep_s)) {
    record_.interval_s = plan.interval_s;
    // A historian's scan classes beat in time: every sample lies on a multiple of its interval.
    const long last = std::lround((end_s - plan.end_early_s) / kStep_s) / steps_a_sample_;
    first_ = (last - static_cast<long>(samples)) * steps_a_sample_;
    record_.start_s = static_cast<double>(first_) * kStep_s;
  }

  /// `master_op` = distance of the master's output from where it started; nullopt = no master.
  void scan(long step, std::optional<double> master_op) {
    if (step % steps_a_scan_ == 0) {
      move_setpoint(master_op);
      sense();
      load_ = keep_ * load_ + fresh_ * random_.normal();
      controller_.step(sp_ - sensed_, plan_.controller.gain, plan_.controller.integral_time_s,
                       plan_.controller.scan_s);
    }
    if (step >= first_ && record_.pv.size() < samples_ && (step - first_) % steps_a_sample_ == 0)
      record();
  }

  /// A master's flow is what its slave measures; any other loop has a valve.
  void move(double inflow, const RunningLoop* slave) {
    if (slave != nullptr) {
      flow_ = slave->pv();
    } else {
      const double position = valve_ ? valve_->step(controller_.op()) : controller_.op();
      flow_ = position - plan_.op0;
    }
    process_.step(flow_, inflow + load_);
  }

  [[nodiscard]] double flow() const { return flow_; }
  [[nodiscard]] bool out_of_span() const { return !(std::abs(process_.pv()) < 50.0); }
  [[nodiscard]] double pv() const { return process_.pv(); }
  [[nodiscard]] double op_rise() const { return controller_.op() - plan_.op0; }
  [[nodiscard]] LoopRecord take() { return std::move(record_); }

 private:
  void move_setpoint(std::optional<double> master_op) {
    if (master_op) {
      sp_ = plan_.master_gain * *master_op;
    } else if (plan_.sp_moves_s > 0.0 &&
               random_.chance(plan_.controller.scan_s / plan_.sp_moves_s)) {
      sp_ = plan_.sp_size * random_.uniform(-1.0, 1.0);
    }
  }

  void sense() {
    const double value = process_.pv() + plan_.noise_sd * random_.normal();
    sensed_ = generators::to_grid(value, plan_.quantum);
  }

  void record() {
    record_.sp.push_back(50.0 + sp_);
    record_.pv.push_back(50.0 + sensed_);
    record_.op.push_back(controller_.op());
  }

  const LoopPlan& plan_;
  std::size_t samples_;
  Random random_;
  ProcessState process_;
  generators::PiController controller_;
  double keep_;   ///< of the load over a scan
  double fresh_;  ///< that joins it
  std::unique_ptr<effects::Valve> valve_;
  long steps_a_scan_;
  long steps_a_sample_;
  long first_ = 0;
  double load_ = 0.0;
  double sp_ = 0.0;
  double sensed_ = 0.0;
  double flow_ = 0.0;
  LoopRecord record_;
};

class RunningStream {
 public:
  explicit RunningStream(const Stream& stream)
      : stream_(stream),
        pipe_(delay_of(stream.delay_s, kStep_s)),
        lag_(lag_of(stream.lag_s, kStep_s)) {}

  void step(const std::vector<RunningLoop>& loops, std::vector<double>& inflows) {
    const RunningLoop& from = loops[stream_.from];
    const double carried = stream_.carries_pv ? from.pv() : from.flow();
    inflows[stream_.to] += stream_.gain * lag_.step(pipe_.step(carried));
  }

 private:
  Stream stream_;
  Delay pipe_;
  Lag lag_;
};

class RunningOutside {
 public:
  RunningOutside(const Outside& outside, std::uint64_t seed) : outside_(outside), random_(seed) {}

  void step(std::vector<double>& inflows) {
    if (outside_.amplitude == 0.0) return;
    const double turn = kStep_s / outside_.period_s;
    phase_ += 2.0 * std::numbers::pi * turn + outside_.wander * std::sqrt(turn) * random_.normal();
    const double value =
        outside_.amplitude * (std::sin(phase_) + outside_.third * std::sin(3.0 * phase_));
    for (std::size_t i = 0; i < outside_.loops.size(); ++i)
      inflows[outside_.loops[i]] += outside_.gains[i] * value;
  }

 private:
  const Outside& outside_;
  Random random_;
  double phase_ = 0.0;
};

class RunningPlant {
 public:
  RunningPlant(const PlantPlan& plan, std::size_t samples)
      : plan_(plan),
        outside_(plan.outside, effects::seed_for("outside", plan.noise_seed)),
        inflows_(plan.loops.size(), 0.0) {
    const double end_s = last_sample_s(plan, samples);
    last_step_ = std::lround(end_s / kStep_s);
    for (std::size_t i = 0; i < plan.loops.size(); ++i)
      loops_.emplace_back(plan.loops[i], effects::seed_for(plan.loops[i].name, plan.noise_seed + i),
                          end_s, samples);
    slaves_.resize(plan.loops.size());
    for (std::size_t i = 0; i < plan.loops.size(); ++i)
      if (plan.loops[i].master) slaves_[*plan.loops[i].master] = i;
    for (const Stream& stream : plan.streams) streams_.emplace_back(stream);
  }

  std::vector<LoopRecord> run() {
    for (long step = 0; step <= last_step_; ++step) {
      std::ranges::fill(inflows_, 0.0);
      for (RunningStream& stream : streams_) stream.step(loops_, inflows_);
      outside_.step(inflows_);
      for (std::size_t i = 0; i < loops_.size(); ++i) step_loop(step, i);
      if (std::ranges::any_of(loops_, &RunningLoop::out_of_span)) return {};
    }
    std::vector<LoopRecord> records;
    for (RunningLoop& loop : loops_) records.push_back(loop.take());
    return records;
  }

 private:
  void step_loop(long step, std::size_t i) {
    const std::optional<std::size_t>& master = plan_.loops[i].master;
    loops_[i].scan(step, master ? std::optional(loops_[*master].op_rise()) : std::nullopt);
    loops_[i].move(inflows_[i], slaves_[i] ? &loops_[*slaves_[i]] : nullptr);
  }

  const PlantPlan& plan_;
  std::vector<RunningLoop> loops_;
  std::vector<std::optional<std::size_t>> slaves_;  ///< of each loop that is a master
  std::vector<RunningStream> streams_;
  RunningOutside outside_;
  std::vector<double> inflows_;
  long last_step_ = 0;
};

}  // namespace

std::vector<LoopRecord> simulate(const PlantPlan& plan, std::size_t samples) {
  return RunningPlant(plan, samples).run();
}

}  // namespace loopscope::tests::network
