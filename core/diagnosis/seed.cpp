#include "core/diagnosis/seed.hpp"

namespace loopscope::core {
namespace {

constexpr std::uint64_t kOffsetBasis = 0xcbf29ce484222325U;
constexpr std::uint64_t kPrime = 0x100000001b3U;

std::uint64_t mix(std::uint64_t hash, unsigned char byte) {
  return (hash ^ byte) * kPrime;
}

}  // namespace

std::uint64_t seed_of(std::string_view loop_name, std::int64_t end_us) {
  std::uint64_t hash = kOffsetBasis;
  for (const char letter : loop_name) hash = mix(hash, static_cast<unsigned char>(letter));
  const auto time = static_cast<std::uint64_t>(end_us);
  for (unsigned shift = 0; shift < 64; shift += 8) {
    hash = mix(hash, static_cast<unsigned char>(time >> shift));
  }
  return hash;
}

}  // namespace loopscope::core
