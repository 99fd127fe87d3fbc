#include "tests/core/loop/signals.hpp"

#include <cmath>
#include <numbers>

#include "tests/support/numbers.hpp"

namespace loopscope::core::loop::signals {
namespace {

using loopscope::tests::kTurn;
constexpr std::size_t kSettling = 1500;

double variance(const Series& series) {
  double mean = 0.0;
  for (const double x : series) mean += x / static_cast<double>(series.size());
  double squares = 0.0;
  for (const double x : series) squares += (x - mean) * (x - mean);
  return squares / static_cast<double>(series.size());
}

Series last(const Series& series, std::size_t count) {
  return {series.end() - static_cast<std::ptrdiff_t>(count), series.end()};
}

/// One sample at a time, because the loop is closed around it.
class Valve {
 public:
  Valve(double s, double j) : static_(0.5 * (s + j)), dynamic_(0.5 * (s - j)) {}

  double move_to(double op) {
    force_ += op - op_;
    op_ = op;
    if (std::abs(force_) <= static_) return position_;
    force_ = std::copysign(dynamic_, force_);
    return position_ = op - force_;
  }

 private:
  double static_, dynamic_;
  double op_ = 0.0, force_ = 0.0, position_ = 0.0;
};

}  // namespace

Series white(Random& random, std::size_t count) {
  std::normal_distribution<double> normal;
  Series series(count);
  for (double& x : series) x = normal(random);
  return series;
}

Series ar1(Random& random, std::size_t count, double phi) {
  Series series = white(random, count);
  if (phi < 1.0) series[0] /= std::sqrt(1.0 - phi * phi);
  for (std::size_t k = 1; k < count; ++k) series[k] += phi * series[k - 1];
  return series;
}

Series resonance(Random& random, std::size_t count, double period, double damping) {
  Series series = white(random, count + kSettling);
  const double first = 2.0 * damping * std::cos(kTurn / period);
  for (std::size_t k = 2; k < series.size(); ++k) {
    series[k] += first * series[k - 1] - damping * damping * series[k - 2];
  }
  return last(series, count);
}

Series wave(Random& random, std::size_t count, Wave kind, double period, double jitter) {
  std::normal_distribution<double> normal;
  double phase = std::uniform_real_distribution<double>(0.0, kTurn)(random);
  Series series(count);
  for (double& x : series) {
    phase += kTurn / period + jitter * std::sqrt(kTurn / period) * normal(random);
    x = std::sin(phase);
    if (kind == Wave::square) x = std::copysign(1.0, x);
    if (kind == Wave::triangle) x = std::asin(x) * 4.0 / kTurn;
  }
  return series;
}

Series sum(Series series, const Series& other, double scale) {
  for (std::size_t k = 0; k < series.size(); ++k) series[k] += scale * other[k];
  return series;
}

Series at_snr(const Series& series, const Series& noise, double snr_db) {
  const double ratio = variance(series) / variance(noise) / std::pow(10.0, snr_db / 10.0);
  return sum(series, noise, std::sqrt(ratio));
}

Series with_missing(Random& random, Series series, double probability) {
  std::bernoulli_distribution missing(probability);
  for (double& x : series) {
    if (missing(random)) x = std::nan("");
  }
  return series;
}

SimulatedLoop simulate(Random& random, std::size_t count, const LoopSettings& settings) {
  const std::size_t total = count + kSettling;
  const Series steps = white(random, total);
  Series pv(total, 0.0), op(total, 0.0), mv(total, 0.0);
  Valve valve(settings.stickband, settings.slip_jump);
  double process = 0.0, walk = 0.0, error_before = 0.0;
  for (std::size_t k = 4; k < total; ++k) {
    process = 0.8 * process + 1.45 * mv[k - 3] - mv[k - 4];
    walk += settings.walk_std * steps[k];
    pv[k] = process + walk +
            settings.sinusoid_amplitude * std::sin(kTurn * 0.01 * static_cast<double>(k));
    const double error = settings.setpoint_step - pv[k];
    op[k] = op[k - 1] + settings.gain * (error - error_before) + settings.integral * error;
    error_before = error;
    mv[k] = valve.move_to(op[k]);
  }
  return {last(pv, count), last(op, count), last(mv, count)};
}

Series through_valve(const Series& op, double s, double j) {
  Valve valve(s, j);
  Series mv;
  for (const double x : op) mv.push_back(valve.move_to(x));
  return mv;
}

}  // namespace loopscope::core::loop::signals
