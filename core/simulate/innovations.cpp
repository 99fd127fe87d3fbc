#include "core/simulate/innovations.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/simulate/random.hpp"
#include "core/simulate/uniform_source.hpp"

namespace loopscope::core::simulate {
namespace {

/// Inverse distribution functions, scaled to mean 0 and variance 1.
double exponential(double u) {
  return -std::log(u) - 1.0;
}
double uniform(double u) {
  return 2.0 * std::numbers::sqrt3 * (u - 0.5);
}
double laplace(double u) {
  const double tail = u < 0.5 ? std::log(2.0 * u) : -std::log(2.0 * (1.0 - u));
  return tail / std::numbers::sqrt2;
}

std::vector<double> gaussian(std::size_t samples, std::uint64_t seed) {
  GaussianSource source(seed);
  std::vector<double> values(samples);
  for (double& value : values) {
    value = source.next();
  }
  return values;
}

std::vector<double> inverted(double (*inverse)(double), std::size_t samples, std::uint64_t seed) {
  UniformSource source(seed);
  std::vector<double> values(samples);
  for (double& value : values) {
    value = inverse(source.next());
  }
  return values;
}

}  // namespace

std::string_view name(Innovation law) {
  switch (law) {
    case Innovation::gaussian:
      return "gaussian";
    case Innovation::exponential:
      return "exponential";
    case Innovation::uniform:
      return "uniform";
    case Innovation::laplace:
      return "laplace";
  }
  throw std::invalid_argument("innovations: unknown law");
}

std::vector<double> innovations(Innovation law, std::size_t samples, std::uint64_t seed) {
  switch (law) {
    case Innovation::gaussian:
      return gaussian(samples, seed);
    case Innovation::exponential:
      return inverted(exponential, samples, seed);
    case Innovation::uniform:
      return inverted(uniform, samples, seed);
    case Innovation::laplace:
      return inverted(laplace, samples, seed);
  }
  throw std::invalid_argument("innovations: unknown law");
}

}  // namespace loopscope::core::simulate
