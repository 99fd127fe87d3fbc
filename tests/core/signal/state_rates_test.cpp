#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <string>

#include "core/signal/order/spread.hpp"
#include "core/signal/prepare.hpp"
#include "core/simulate/random.hpp"
#include "tests/support/long_run.hpp"

namespace loopscope::core::signal {
namespace {

struct Random {
  explicit Random(std::uint64_t seed) : gauss(seed), even(seed + 1) {}
  double normal() { return gauss.next(); }
  double uniform(double low, double high) { return low + (high - low) * even.next(); }
  bool chance(double probability) { return even.next() < probability; }
  simulate::GaussianSource gauss;
  simulate::UniformSource even;
};

/// One healthy PI loop about its setpoint, as a plant records it.
struct HealthyLoop {
  double tau = 10.0;  ///< samples
  double load_pole = 0.9;
  double load = 1.0;  ///< standard deviation of what drives it, in units of the noise
  double noise = 0.1;
  double setpoint = 50.0;
  bool controller_sees_grid = false;
};

HealthyLoop drawn_loop(Random& random) {
  HealthyLoop loop;
  loop.tau = std::exp(random.uniform(1.0, 4.0));
  loop.load_pole = 1.0 - std::exp(random.uniform(-7.0, -2.0));
  loop.load = std::exp(random.uniform(-4.0, 2.0));
  loop.noise = std::exp(random.uniform(-4.0, 0.0));
  loop.setpoint = random.chance(0.5) ? 50.0 : random.uniform(40.0, 60.0);
  loop.controller_sees_grid = random.chance(0.5);
  return loop;
}

double on_grid(double value, double step, bool truncated) {
  if (!(step > 0.0)) return value;
  return step * (truncated ? std::floor(value / step) : std::round(value / step));
}

/// Of a transmitter that stops at sample `dead_from`, for the controller too.
constexpr std::size_t kNever = static_cast<std::size_t>(-1);

LoopWindow simulated(const HealthyLoop& loop, double step, bool truncated, std::size_t samples,
                     Random& random, std::size_t dead_from = kNever) {
  LoopWindow window;
  const double gain = 0.5;
  const double kc = 0.5 * loop.tau / 3.0 / gain / 2.0;
  const double ti = std::min(loop.tau, 12.0);
  double load = 0.0, state = loop.setpoint, integral = loop.setpoint / gain;
  const double drive = loop.load * loop.noise * std::sqrt(1.0 - loop.load_pole * loop.load_pole);
  double op = integral;
  for (std::size_t k = 0; k < samples; ++k) {
    load = loop.load_pole * load + drive * random.normal();
    state += (gain * op + load - state) / loop.tau;
    const double live = state + loop.noise * random.normal();
    const double fine = k >= dead_from && k > 0 ? window.pv.back() : live;
    const double read = on_grid(fine, step, truncated);
    const double error = loop.setpoint - (loop.controller_sees_grid ? read : fine);
    integral += kc / ti * error;
    integral = std::clamp(integral, 0.0, 200.0);
    op = std::clamp(integral + kc * error, 0.0, 200.0);
    window.pv.push_back(read);
    window.sp.push_back(loop.setpoint);
    window.op.push_back(op);
  }
  return window;
}

/// Stored when it has left a band about the value stored last; held in between.
void hold_in_band(Samples& samples, double band) {
  double kept = samples.front();
  for (double& value : samples) {
    if (std::abs(value - kept) > band) kept = value;
    value = kept;
  }
}

double spread_of(const Samples& samples) {
  double mean = 0.0, square = 0.0;
  for (const double v : samples) mean += v / static_cast<double>(samples.size());
  for (const double v : samples)
    square += (v - mean) * (v - mean) / static_cast<double>(samples.size());
  return std::sqrt(square);
}

LoopWindow part_of(const LoopWindow& whole, std::size_t first, std::size_t samples) {
  const auto cut = [&](const Samples& series) {
    const auto begin = series.begin() + static_cast<std::ptrdiff_t>(first);
    return Samples(begin, begin + static_cast<std::ptrdiff_t>(samples));
  };
  LoopWindow window = whole;
  window.pv = cut(whole.pv);
  window.sp = cut(whole.sp);
  window.op = cut(whole.op);
  return window;
}

enum class Kind { coarse, calm, compressed };

/// Grid or band over the spread of the signal. Beyond this hardly anything of it is left, and a
/// window may hold one value: that looks like a transmitter that died.
constexpr double kWidest = 2.5;

double between(double low, double high, Random& random) {
  return std::exp(random.uniform(std::log(low), std::log(high)));
}

/// Two windows of a healthy loop that is coarse, calm or compressed, one after the other.
LoopWindow drawn_window(Kind kind, std::size_t samples, Random& random) {
  HealthyLoop loop = drawn_loop(random);
  if (kind == Kind::calm) loop.load *= 0.1;
  const double pv_spread = loop.noise * (1.0 + loop.load * 0.3);
  const double step = kind == Kind::compressed ? 0.0 : pv_spread * between(0.3, kWidest, random);
  LoopWindow window = simulated(loop, step, random.chance(0.3), samples, random);
  if (kind == Kind::compressed) {
    hold_in_band(window.pv, spread_of(window.pv) * between(0.3, kWidest, random));
    if (random.chance(0.5))
      hold_in_band(window.op, spread_of(window.op) * between(0.3, kWidest, random));
  }
  if (random.chance(0.5)) window.mode.assign(samples, ControlMode::automatic);
  return window;
}

struct Counts {
  int windows = 0, still = 0, whole = 0, flat = 0, not_controlling = 0, at_limit = 0;
};

Counts judge(Kind kind, std::size_t samples, bool with_past, int draws, std::uint64_t seed) {
  Counts counts;
  PrepareSettings settings;
  settings.window_samples = samples;
  for (int draw = 0; draw < draws; ++draw) {
    Random random(seed + static_cast<std::uint64_t>(draw));
    LoopWindow whole = drawn_window(kind, 2 * samples, random);
    if (!whole.mode.empty()) whole.mode.resize(samples);
    LoopWindow window = part_of(whole, samples, samples);
    if (with_past) window.pv_past = prepare(part_of(whole, 0, samples), settings).past;
    const PreparedLoop loop = prepare(window, settings);
    ++counts.windows;
    counts.still += loop.still ? 1 : 0;
    counts.whole += loop.still && loop.still->whole ? 1 : 0;
    counts.flat += std::ranges::any_of(flat_runs(window.pv), is_long) ? 1 : 0;
    counts.not_controlling += loop.control.controlling() ? 0 : 1;
    counts.at_limit += loop.control.held_at_limit ? 1 : 0;
  }
  return counts;
}

struct FoundDead {
  int windows = 0, still = 0;
};

/// Dead for the last `dead` of `samples`: the transmitter itself, or the line to the archive alone.
FoundDead find_dead(std::size_t dead, std::size_t samples, bool for_controller, int draws) {
  FoundDead found;
  PrepareSettings settings;
  settings.window_samples = samples;
  for (int draw = 0; draw < draws; ++draw) {
    Random random(2000000 + static_cast<std::uint64_t>(draw));
    const HealthyLoop loop = drawn_loop(random);
    const double step = random.chance(0.5) ? loop.noise * random.uniform(0.1, 1.0) : 0.0;
    const std::size_t from = 2 * samples - dead;
    LoopWindow whole =
        simulated(loop, step, false, 2 * samples, random, for_controller ? from : kNever);
    if (!for_controller)
      std::fill(whole.pv.begin() + static_cast<std::ptrdiff_t>(from), whole.pv.end(),
                whole.pv[from]);
    if (random.chance(0.5)) whole.mode.assign(samples, ControlMode::automatic);
    whole.op_range = OpRange{0.0, 200.0};
    ++found.windows;
    found.still += prepare(part_of(whole, samples, samples), settings).still ? 1 : 0;
  }
  return found;
}

/// Nine in ten of those that are dead for a third of the window, or all of it. What is not found is
/// calm: its error within a step, its op within half a percent.
TEST(StateRates, DeadTransmittersStandStill) {
  const auto draws = static_cast<int>(loopscope::tests::records(500));
  FoundDead all;
  for (const bool for_controller : {true, false}) {
    for (const std::size_t dead : {std::size_t{400}, std::size_t{700}, std::size_t{1024}}) {
      const FoundDead found = find_dead(dead, 1024, for_controller, draws);
      std::cout << (for_controller ? "transmitter" : "archive") << " dead for " << dead
                << " of 1024 samples: " << found.still << " of " << found.windows << "\n";
      all.windows += found.windows;
      all.still += found.still;
    }
  }
  EXPECT_GE(10 * all.still, 9 * all.windows);
}

/// At most one window of a healthy loop in a thousand is said to stand still.
TEST(StateRates, HealthyLoopsStandStillInOneWindowOfAThousandAtMost) {
  const auto draws = static_cast<int>(loopscope::tests::records(750));
  int windows = 0, still = 0;
  for (const Kind kind : {Kind::coarse, Kind::calm, Kind::compressed}) {
    for (const std::size_t samples : {std::size_t{1024}, std::size_t{4096}}) {
      for (const bool with_past : {false, true}) {
        const Counts counts = judge(kind, samples, with_past, draws, 1000000);
        std::cout << "kind " << static_cast<int>(kind) << ", " << samples << " samples, past "
                  << with_past << ": " << counts.still << " still (" << counts.whole << " whole), "
                  << counts.flat << " with a run of 300, " << counts.not_controlling
                  << " not controlling, " << counts.at_limit << " at limit, of " << counts.windows
                  << "\n";
        windows += counts.windows;
        still += counts.still;
      }
    }
  }
  EXPECT_LE(still, windows / 1000 + 2) << "of " << windows;
}

/// A controller of a calm loop whose output is told in coarse steps acts all the same, whether the
/// mode says so or not: at most one window in a thousand is said to have none by the moves of its
/// output alone.
TEST(StateRates, ACoarseOutputIsAController) {
  const auto draws = static_cast<int>(loopscope::tests::records(3000));
  int lost = 0, coarse = 0;
  for (int draw = 0; draw < draws; ++draw) {
    Random random(3000000 + static_cast<std::uint64_t>(draw));
    HealthyLoop loop = drawn_loop(random);
    loop.load *= between(0.03, 1.0, random);
    LoopWindow window = simulated(loop, loop.noise * random.uniform(0.0, 1.0), false, 4096, random);
    const double step = spread_of(window.op) * between(0.5, 10.0, random);
    for (double& op : window.op) op = on_grid(op, step, false);
    window.mode.assign(4096, ControlMode::automatic);
    window.op_range = OpRange{0.0, 200.0};
    const PreparedLoop prepared = prepare(window, PrepareSettings{});
    coarse += share_of_moves(window.op) < 0.1 ? 1 : 0;
    lost += prepared.op_moves && !prepared.control.controlling() ? 1 : 0;
  }
  std::cout << lost << " of " << draws << " without a controller, " << coarse
            << " with an output that moves in less than a tenth of the samples\n";
  EXPECT_LE(lost, draws / 1000 + 1);
}

}  // namespace
}  // namespace loopscope::core::signal
