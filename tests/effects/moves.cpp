#include <algorithm>
#include <cmath>

#include "tests/effects/draft.hpp"

namespace loopscope::tests::effects {
namespace {

constexpr double kMostKick = 25.0;    ///< % of op that a move of the set point may cause at once
constexpr double kMostOutput = 15.0;  ///< % of op that small moves may need

/// In the run-in, so that a record starts anywhere between two moves.
constexpr std::size_t kFirstMove = 300;

/// Samples until the loop has come to rest after a move, roughly.
double settling(const Scenario& scenario) {
  const Process& process = scenario.process;
  const double slowest = process.integrating
                             ? scenario.controller.ti
                             : process.tau + process.second_tau + scenario.controller.ti;
  return std::min(600.0, 2.0 * slowest + 5.0 * process.delay);
}

double small_reach(const Draft& draft, Random& random) {
  const Scenario& scenario = draft.base;
  double reach = random.uniform(draft.options.reach.low, draft.options.reach.high);
  if (!scenario.process.integrating)
    reach = std::min(reach, kMostOutput * std::abs(scenario.process.gain));
  return std::min(reach, kMostKick / std::abs(scenario.controller.kc));
}

/// The levels that the set point takes one after the other.
class Levels {
 public:
  Levels(const Draft& draft, Random& random)
      : draft_(draft), random_(random), staircase_(random.chance(0.25)) {
    if (draft.options.moves != Moves::large || draft.base.process.integrating)
      reach_ = small_reach(draft, random);
  }

  double next() {
    if (staircase_)
      climb();
    else
      jump();
    return reach_ > 0.0 ? place_ * reach_
                        : resting_pv(draft_.scenario,
                                     draft_.scenario.op0 + place_ * draft_.options.op_range / 2.0);
  }

 private:
  void climb() {
    if (std::abs(place_ + step_) > 1.0) step_ = -step_;
    place_ += step_;
  }
  /// Always a fair part of the reach away from the last level.
  void jump() {
    const double from = place_;
    while (std::abs(place_ - from) < 0.35) place_ = random_.uniform(-1.0, 1.0);
  }

  const Draft& draft_;
  Random& random_;
  bool staircase_;
  double reach_ = 0.0;  ///< 0 = levels are those of op
  double place_ = 0.0;  ///< -1 to 1
  double step_ = 0.4;
};

/// Samples over which a move is spread: a step, or a ramp where a step would throw op about.
std::size_t ramp_samples(const Scenario& scenario, double move, Random& random) {
  const double kick = std::abs(scenario.controller.kc * move);
  if (kick > kMostKick) return static_cast<std::size_t>(std::ceil(10.0 * kick / kMostKick));
  return random.chance(0.3) ? static_cast<std::size_t>(random.whole(10, 50)) : 1;
}

void move_set_point(Draft& draft, Random& random) {
  Scenario& scenario = draft.scenario;
  Levels levels(draft, random);
  double level = 0.0;
  std::size_t k = kFirstMove;
  while (k < scenario.sp.size()) {
    const double dwell = std::max(random.uniform(100.0, 400.0), settling(scenario));
    const double target = levels.next();
    const std::size_t ramp = ramp_samples(scenario, target - level, random);
    const std::size_t end =
        std::min(scenario.sp.size(), k + ramp + static_cast<std::size_t>(dwell));
    for (std::size_t i = 0; k < end; ++i, ++k)
      scenario.sp[k] = level + (target - level) * std::min(1.0, static_cast<double>(i + 1) /
                                                                    static_cast<double>(ramp));
    level = target;
  }
}

/// The level at which as much is lost as flows in.
double balanced_level(const Curve& loss, double flow) {
  double low = -60.0;
  double high = 60.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2.0;
    (loss(middle) < flow ? low : high) = middle;
  }
  return (low + high) / 2.0;
}

}  // namespace

double resting_pv(const Scenario& scenario, double op) {
  const double flow = scenario.trim ? scenario.trim(op) : op - scenario.op0;
  const Process& process = scenario.process;
  if (process.integrating) return process.loss ? balanced_level(process.loss, flow) : 0.0;
  const double straight = process.gain * flow;
  return process.output_curve ? process.output_curve(straight) : straight;
}

void draw_moves(Draft& draft, Random& random) {
  std::fill(draft.scenario.sp.begin(), draft.scenario.sp.end(), 0.0);
  const Moves moves = draft.options.moves;
  const bool moving = moves == Moves::large || moves == Moves::small ||
                      (moves == Moves::sometimes && random.chance(0.3));
  if (moving) move_set_point(draft, random);
}

}  // namespace loopscope::tests::effects
