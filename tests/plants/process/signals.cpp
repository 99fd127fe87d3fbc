#include "tests/plants/process/signals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace loopscope::tests::process {

FilteredNoise::FilteredNoise(double memory_s, bool twice, double step_s, std::uint64_t seed)
    : keep_(std::exp(-step_s / memory_s)),
      fresh_(std::sqrt(1.0 - keep_ * keep_)),
      twice_(twice),
      // The second filter of a first-order process leaves about half of its variance.
      scale_((1.0 + keep_) / std::sqrt(1.0 + keep_ * keep_)),
      random_(seed) {}

double FilteredNoise::step() {
  first_ = keep_ * first_ + fresh_ * random_.normal();
  if (!twice_) return first_;
  second_ = keep_ * second_ + (1.0 - keep_) * first_;
  return scale_ * second_;
}

Upset::Upset(const UpsetPlan& plan, double step_s, std::uint64_t seed)
    : plan_(plan),
      step_s_(step_s),
      noise_(plan.memory_s, plan.smooth, step_s, seed_of_part(seed, 1)),
      swell_(5.0 * plan.wave.period_s, true, step_s, seed_of_part(seed, 2)),
      wander_(seed_of_part(seed, 3)) {}

double Upset::step() {
  const double own = plan_.sd > 0.0 ? plan_.sd * noise_.step() : 0.0;
  return plan_.wave.amplitude > 0.0 ? own + wave() : own;
}

double Upset::wave() {
  const double share = step_s_ / plan_.wave.period_s;
  phase_ += 2.0 * std::numbers::pi * share;
  phase_ += plan_.wave.wander * std::sqrt(share) * wander_.normal();
  const double size = plan_.wave.amplitude * std::clamp(1.0 + 0.3 * swell_.step(), 0.3, 1.7);
  return size * (std::sin(phase_) + plan_.wave.second * std::sin(2.0 * phase_));
}

Sawtooth::Sawtooth(const SawtoothPlan& plan, double step_s, std::uint64_t seed)
    : plan_(plan), step_s_(step_s), random_(seed) {
  begin();
}

void Sawtooth::begin() {
  age_s_ = 0.0;
  length_s_ = plan_.period_s * std::clamp(1.0 + plan_.wander * random_.normal(), 0.5, 1.5);
  // A longer drift goes further.
  height_ = plan_.size * (length_s_ / plan_.period_s) * std::max(0.5, 1.0 + 0.1 * random_.normal());
}

double Sawtooth::step() {
  if (plan_.size == 0.0) return 0.0;
  age_s_ += step_s_;
  if (age_s_ >= length_s_) begin();
  return height_ * (std::pow(age_s_ / length_s_, plan_.bend) - 0.5);
}

}  // namespace loopscope::tests::process
