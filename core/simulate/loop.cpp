#include "core/simulate/loop.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "core/simulate/effect_chain.hpp"
#include "core/simulate/random.hpp"

namespace loopscope::core::simulate {
namespace {

void check_settings(const LoopSettings& settings) {
  const bool noise = settings.load.step_std >= 0.0 && settings.measurement_noise_std >= 0.0;
  const bool memory = settings.load.memory >= 0.0 && settings.load.memory <= 1.0;
  if (!(settings.sample_interval_s > 0.0 && noise && memory && settings.recorded_samples > 0)) {
    throw std::invalid_argument("loop: interval, noise, load memory or length out of range");
  }
}

/// What one sample of the loop leaves in the record.
struct Sample {
  double sp, pv, op, mv;
};

/// The loop while it runs: every part with its state.
class RunningLoop {
 public:
  RunningLoop(const LoopSettings& settings, std::uint64_t seed)
      : settings_(settings),
        process_(settings.process),
        controller_(settings.controller, kOperatingPoint),
        effects_(settings.effects),
        // Two streams: measurement noise may come and go without changing the load.
        load_noise_(seed),
        sensor_noise_(seed ^ kSensorStream) {}

  Sample next() {
    const double time_s =
        settings_.sample_interval_s *
        (static_cast<double>(sample_) - static_cast<double>(settings_.discarded_samples));
    const double load = next_load(time_s);
    const bool load_at_output = settings_.load.entry == LoadEntry::process_output;
    const double true_pv = kOperatingPoint + effects_.process_output(process_.output(), time_s) +
                           (load_at_output ? load : 0.0);
    Sample result{};
    result.sp = setpoint();
    result.pv =
        effects_.measured(true_pv + settings_.measurement_noise_std * sensor_noise_.next(), time_s);
    result.op = controller_.next(result.sp - result.pv);
    // The stem ends at its stops, also where a law's offset would carry it further.
    result.mv = std::clamp(effects_.valve_position(result.op, time_s), 0.0, 100.0);
    const double flow_offset = effects_.flow(result.mv, time_s) - kOperatingPoint;
    process_.advance(effects_.process_input(flow_offset, time_s) + (load_at_output ? 0.0 : load));
    ++sample_;
    return result;
  }

 private:
  /// Any odd constant separates the streams; this one is 2^64 / golden ratio.
  static constexpr std::uint64_t kSensorStream = 0x9E3779B97F4A7C15ULL;

  [[nodiscard]] double setpoint() const {
    double sp = kOperatingPoint;
    for (const SetpointMove& move : settings_.setpoint_moves) {
      sp += sample_ >= move.at_sample ? move.size : 0.0;
    }
    return sp;
  }

  double next_load(double time_s) {
    wandering_ = settings_.load.memory * wandering_ + settings_.load.step_std * load_noise_.next();
    return effects_.load(wandering_, time_s);
  }

  const LoopSettings& settings_;
  Process process_;
  PiController controller_;
  EffectChain effects_;
  GaussianSource load_noise_, sensor_noise_;
  std::size_t sample_ = 0;
  double wandering_ = 0.0;
};

void append(LoopRecord& record, const Sample& sample) {
  record.sp.push_back(sample.sp);
  record.pv.push_back(sample.pv);
  record.op.push_back(sample.op);
  record.mv.push_back(sample.mv);
}

}  // namespace

double PiController::next(double error) {
  const double move = settings_.gain * (error - previous_error_) + settings_.integral * error;
  previous_error_ = error;
  op_percent_ = std::clamp(op_percent_ + move, 0.0, 100.0);
  return op_percent_;
}

LoopRecord simulate_loop(const LoopSettings& settings, std::uint64_t seed) {
  check_settings(settings);
  RunningLoop loop(settings, seed);
  for (std::size_t k = 0; k < settings.discarded_samples; ++k) {
    loop.next();
  }
  LoopRecord record;
  record.sample_interval_s = settings.sample_interval_s;
  for (std::size_t k = 0; k < settings.recorded_samples; ++k) {
    append(record, loop.next());
  }
  return record;
}

std::vector<double> control_error(const LoopRecord& record) {
  std::vector<double> error(record.pv.size());
  std::ranges::transform(record.sp, record.pv, error.begin(), std::minus<>());
  return error;
}

}  // namespace loopscope::core::simulate
