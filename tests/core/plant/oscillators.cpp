#include "tests/core/plant/oscillators.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/hos/numeric/normal_draw.hpp"
#include "tests/support/numbers.hpp"

namespace loopscope::core::plant::tests {

using hos::normal_draw;

double uniform(double low, double high, std::mt19937_64& random) {
  return low + (high - low) * hos::uniform_draw(random);
}

Course draw_course(std::size_t samples, double period, double increments, std::mt19937_64& random) {
  Course course;
  double phase = uniform(0.0, 2.0 * std::numbers::pi, random);
  double size = 0.0;
  const double keep = std::exp(-0.5 / period);
  const double fresh = std::sqrt(1.0 - keep * keep) * std::min(0.3, increments);
  for (std::size_t k = 0; k < samples; ++k) {
    phase += increments / std::sqrt(period) * normal_draw(random);
    size = keep * size + fresh * normal_draw(random);
    course.phase.push_back(phase);
    course.amplitude.push_back(std::exp(size));
  }
  return course;
}

std::vector<double> draw_error(const Course& course, double period, std::size_t lag, double noise,
                               std::size_t samples, std::mt19937_64& random) {
  std::vector<double> error(samples);
  const double keep = std::exp(-1.0 / uniform(1.0, period, random));
  const double turn = uniform(0.0, 2.0 * std::numbers::pi, random);
  double coloured = 0.0;
  for (std::size_t k = 0; k < samples; ++k) {
    const std::size_t from = course.phase.size() - samples - lag + k;
    coloured = keep * coloured + std::sqrt(1.0 - keep * keep) * noise * normal_draw(random);
    error[k] =
        course.amplitude[from] * std::cos(2.0 * std::numbers::pi * static_cast<double>(k) / period +
                                          turn + course.phase[from]) +
        coloured;
  }
  return error;
}

MemberLoop oscillating_loop(std::int64_t id, const std::vector<double>& error) {
  MemberLoop loop;
  loop.id = id;
  loop.name = "L" + std::to_string(id);
  loop.start_us = 1'700'000'000'000'000;
  loop.error = error;
  return loop;
}

void OscillatingPlant::add(const Course& course, double period, std::mt19937_64& random,
                           int group) {
  constexpr double kLongestLag = 600.0;  // samples, before the window
  const auto lag = static_cast<std::size_t>(uniform(0.0, std::min(kLongestLag, period), random));
  errors.push_back(draw_error(course, period, lag, uniform(0.2, 0.8, random),
                              loopscope::tests::kWindow, random));
  groups.push_back(group);
}

const std::vector<MemberLoop>& OscillatingPlant::finish() {
  loops.clear();
  for (std::size_t k = 0; k < errors.size(); ++k)
    loops.push_back(oscillating_loop(static_cast<std::int64_t>(k), errors[k]));
  return loops;
}

}  // namespace loopscope::core::plant::tests
