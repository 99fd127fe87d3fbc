#include "tests/effects/random.hpp"

#include <cmath>
#include <numbers>

namespace loopscope::tests::effects {

std::uint64_t Random::next() {
  state_ += 0x9E3779B97F4A7C15ULL;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

double Random::uniform(double low, double high) {
  const double unit = static_cast<double>(next() >> 11) * 0x1.0p-53;
  return low + (high - low) * unit;
}

double Random::log_uniform(double low, double high) {
  return std::exp(uniform(std::log(low), std::log(high)));
}

double Random::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0)));
  return radius * std::cos(2.0 * std::numbers::pi * uniform(0.0, 1.0));
}

bool Random::chance(double probability) {
  return uniform(0.0, 1.0) < probability;
}

int Random::whole(int low, int high) {
  return low + static_cast<int>(uniform(0.0, static_cast<double>(high - low + 1)));
}

double Random::pick(std::initializer_list<double> values) {
  return values.begin()[whole(0, static_cast<int>(values.size()) - 1)];
}

std::uint64_t seed_for(std::string_view use, std::uint64_t seed) {
  std::uint64_t hash = 0xCBF29CE484222325ULL;  // FNV-1a
  for (const char letter : use)
    hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001B3ULL;
  return Random(hash ^ Random(seed).next()).next();
}

}  // namespace loopscope::tests::effects
