#include "daemon/lab/calibrate/record_seed.hpp"

namespace loopscope::daemon {
namespace {

/// FNV-1a, 64 bits: offset basis and prime as its authors give them.
std::uint64_t hash(std::string_view text) {
  std::uint64_t value = 0xCBF29CE484222325ULL;
  for (const char byte : text) {
    value = (value ^ static_cast<unsigned char>(byte)) * 0x100000001B3ULL;
  }
  return value;
}

/// The output function of splitmix64 (Steele, Lea and Flood 2014): neighbours become unrelated.
std::uint64_t mixed(std::uint64_t value) {
  value = (value ^ (value >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  value = (value ^ (value >> 27U)) * 0x94D049BB133111EBULL;
  return value ^ (value >> 31U);
}

}  // namespace

std::uint64_t record_seed(std::string_view stream, std::uint64_t index) {
  constexpr std::uint64_t kGoldenStep = 0x9E3779B97F4A7C15ULL;
  return mixed(hash(stream) + (index + 1) * kGoldenStep);
}

}  // namespace loopscope::daemon
