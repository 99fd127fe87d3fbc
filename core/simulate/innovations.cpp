#include "core/simulate/innovations.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/simulate/random.hpp"

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

std::vector<double> student(int freedom, std::size_t samples, std::uint64_t seed) {
  GaussianSource source(seed);
  std::vector<double> values(samples);
  for (double& value : values) {
    const double numerator = source.next();
    double squares = 0.0;
    for (int i = 0; i < freedom; ++i) {
      const double part = source.next();
      squares += part * part;
    }
    // Over sqrt(squares / freedom) it is Student's, of variance freedom / (freedom - 2).
    value = numerator * std::sqrt((freedom - 2.0) / squares);
  }
  return values;
}

/// Normal values, each louder by kLouder where `loud` says so at its uniform number; `share` of
/// all.
template <typename Loud>
std::vector<double> louder(double share, std::size_t samples, std::uint64_t seed, Loud loud) {
  constexpr double kLouder = 5.0;
  UniformSource uniform(~seed);  // a stream of its own
  std::vector<double> values = gaussian(samples, seed);
  const double std = std::sqrt(1.0 - share + share * kLouder * kLouder);
  for (double& value : values) value *= (loud(uniform.next()) ? kLouder : 1.0) / std;
  return values;
}

std::vector<double> contaminated(std::size_t samples, std::uint64_t seed) {
  constexpr double kShare = 0.02;
  return louder(kShare, samples, seed, [](double u) { return u < kShare; });
}

std::vector<double> bursts(std::size_t samples, std::uint64_t seed) {
  constexpr double kShare = 0.1;
  constexpr double kLength = 50.0;
  bool inside = false;
  return louder(kShare, samples, seed, [&inside](double u) {
    const double change = inside ? 1.0 / kLength : kShare / (1.0 - kShare) / kLength;
    if (u < change) inside = !inside;
    return inside;
  });
}

std::vector<double> garch(std::size_t samples, std::uint64_t seed) {
  std::vector<double> values = gaussian(samples, seed);
  double variance = 1.0;
  double last = 0.0;
  for (double& value : values) {
    variance = 0.05 + 0.15 * last * last + 0.8 * variance;
    value *= std::sqrt(variance);
    last = value;
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
    case Innovation::student_5:
      return "student_5";
    case Innovation::student_3:
      return "student_3";
    case Innovation::contaminated:
      return "contaminated";
    case Innovation::bursts:
      return "bursts";
    case Innovation::garch:
      return "garch";
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
    case Innovation::student_5:
      return student(5, samples, seed);
    case Innovation::student_3:
      return student(3, samples, seed);
    case Innovation::contaminated:
      return contaminated(samples, seed);
    case Innovation::bursts:
      return bursts(samples, seed);
    case Innovation::garch:
      return garch(samples, seed);
  }
  throw std::invalid_argument("innovations: unknown law");
}

}  // namespace loopscope::core::simulate
