#include "tests/effects/loop_frequency.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/generators/lag.hpp"

namespace loopscope::tests::effects {
namespace {

constexpr double kSettlingTaus = 12.0;  ///< e^-12: nothing is left of the lags
constexpr std::size_t kGridPoints = 500;

std::size_t settling_samples(const Process& process) {
  const double lag = process.integrating ? 0.0 : process.tau;
  return static_cast<std::size_t>(kSettlingTaus * (lag + process.second_tau) + process.delay) + 3;
}

/// pv at the samples after op stepped by 1 at sample 0.
std::vector<double> step_response(const Process& process) {
  const auto delay = static_cast<std::size_t>(std::lround(process.delay * kSubsteps));
  const double share = generators::lag_share(process.tau, kStep);
  generators::Lag second(generators::lag_share(process.second_tau, kStep));
  double x = 0.0;
  std::vector<double> response;
  for (std::size_t i = 0; response.size() < settling_samples(process); ++i) {
    if (i % kSubsteps == 0) response.push_back(second.value());
    const double flow = i >= delay ? 1.0 : 0.0;
    x += process.integrating ? kStep * process.gain / process.tau * flow
                             : share * (process.gain * flow - x);
    second.step(x);
  }
  return response;
}

}  // namespace

LoopFrequency::LoopFrequency(const Process& process) {
  const std::vector<double> response = step_response(process);
  if (process.integrating) slope_ = process.gain / process.tau;
  for (std::size_t i = 1; i < response.size(); ++i)
    impulse_.push_back(response[i] - response[i - 1] - slope_);
  for (std::size_t i = 0; i < kGridPoints; ++i) {
    const double share = static_cast<double>(i) / (kGridPoints - 1);
    grid_.push_back(std::numbers::pi * std::pow(1e-4, 1.0 - share));
    on_grid_.push_back(process_at(grid_.back()));
  }
}

LoopFrequency::Complex LoopFrequency::process_at(double frequency) const {
  const Complex back = std::polar(1.0, -frequency);
  Complex sum = 0.0;
  for (std::size_t i = impulse_.size(); i-- > 0;) sum = (sum + impulse_[i]) * back;
  return sum + slope_ * back / (1.0 - back);
}

std::vector<LoopFrequency::Complex> LoopFrequency::open_loop(const Controller& controller) const {
  std::vector<Complex> loop;
  for (std::size_t i = 0; i < grid_.size(); ++i) {
    const Complex integral = 1.0 / (controller.ti * (1.0 - std::polar(1.0, -grid_[i])));
    loop.push_back(controller.kc * (1.0 + integral) * on_grid_[i]);
  }
  return loop;
}

double LoopFrequency::gain_margin(const Controller& controller) const {
  const std::vector<Complex> loop = open_loop(controller);
  double margin = -loop.back().real() > 0.0 ? -1.0 / loop.back().real()
                                            : std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < loop.size(); ++i) {
    const bool crosses = loop[i - 1].imag() < 0.0 && loop[i].imag() >= 0.0 && loop[i].real() < 0.0;
    if (crosses) margin = std::min(margin, -2.0 / (loop[i].real() + loop[i - 1].real()));
  }
  return margin;
}

double LoopFrequency::peak_sensitivity(const Controller& controller) const {
  double peak = 0.0;
  for (const Complex& value : open_loop(controller))
    peak = std::max(peak, 1.0 / std::abs(1.0 + value));
  return peak;
}

double LoopFrequency::sensitivity(const Controller& controller, double frequency) const {
  const Complex integral = 1.0 / (controller.ti * (1.0 - std::polar(1.0, -frequency)));
  return 1.0 / std::abs(1.0 + controller.kc * (1.0 + integral) * process_at(frequency));
}

double LoopFrequency::process_gain(double frequency) const {
  return std::abs(process_at(frequency));
}

}  // namespace loopscope::tests::effects
