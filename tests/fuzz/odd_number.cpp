#include "tests/fuzz/odd_number.hpp"

#include <array>
#include <limits>

namespace loopscope::tests::fuzz {
namespace {

using Limits = std::numeric_limits<double>;

constexpr std::array kOdd = {0.0,
                             -0.0,
                             1.0,
                             -1.0,
                             50.0,
                             100.0,
                             1e-12,
                             1e12,
                             1e100,
                             -1e100,
                             1e154,
                             -1e154,
                             1e200,
                             1e300,
                             -1e300,
                             1e-160,
                             1e-300,
                             Limits::max(),
                             Limits::lowest(),
                             Limits::min(),
                             Limits::denorm_min(),
                             Limits::epsilon(),
                             Limits::infinity(),
                             -Limits::infinity(),
                             Limits::quiet_NaN()};

}  // namespace

double odd_number(ByteSource& source) {
  const std::size_t choice = source.byte() % (kOdd.size() + 8);
  if (choice < kOdd.size()) return kOdd[choice];
  if (choice < kOdd.size() + 4) return static_cast<double>(source.number<std::int16_t>()) / 64.0;
  return source.number<double>();
}

}  // namespace loopscope::tests::fuzz
