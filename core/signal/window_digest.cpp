#include "core/signal/window_digest.hpp"

#include <bit>
#include <cmath>
#include <cstdint>

namespace loopscope::core::signal {
namespace {

/// Fowler, Noll and Vo: offset basis and prime of the 64-bit variant 1a.
constexpr std::uint64_t kOffsetBasis = 14695981039346656037ULL;
constexpr std::uint64_t kPrime = 1099511628211ULL;

/// Every missing sample counts the same, and so do both zeros.
std::uint64_t word_of(double value) {
  return std::bit_cast<std::uint64_t>(std::isnan(value) ? kMissing : value + 0.0);
}

/// The same by words of eight bytes, an eighth of the multiplications. A product carries upwards
/// only, so the upper half is folded back: a change of any bit reaches all of them two words later.
class WordHash {
 public:
  void add(std::uint64_t word) {
    hash_ = (hash_ ^ word) * kPrime;
    hash_ ^= hash_ >> 32;
  }

  void add(double value) { add(word_of(value)); }

  void add(const Samples& samples) {
    add(std::uint64_t{samples.size()});
    for (const double value : samples) add(value);
  }

  void add(std::string_view text) {
    for (const char c : text) add(std::uint64_t{static_cast<unsigned char>(c)});
  }

  [[nodiscard]] std::string hexadecimal() const {
    constexpr std::string_view kHexDigits = "0123456789abcdef";
    WordHash last = *this;
    for (int round = 0; round < 2; ++round) last.add(std::uint64_t{0});
    std::string text;
    for (int shift = 60; shift >= 0; shift -= 4) text += kHexDigits[(last.hash_ >> shift) & 0xF];
    return text;
  }

 private:
  std::uint64_t hash_ = kOffsetBasis;
};

}  // namespace

std::string window_digest(const LoopWindow& window, std::string_view settings) {
  WordHash hash;
  hash.add(window.sample_interval_s);
  hash.add(std::bit_cast<std::uint64_t>(window.start_us));
  for (const Samples* series : {&window.sp, &window.pv, &window.op, &window.mv}) hash.add(*series);
  if (!window.pv_rows.empty()) hash.add(window.pv_rows);
  for (const ControlMode mode : window.mode) hash.add(static_cast<std::uint64_t>(mode));
  hash.add(window.op_range ? window.op_range->low : kMissing);
  hash.add(window.op_range ? window.op_range->high : kMissing);
  hash.add(settings);
  return hash.hexadecimal();
}

std::uint64_t window_seed(const LoopWindow& window) {
  std::uint64_t hash = kOffsetBasis;
  const auto add = [&hash](std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) {
      hash = (hash ^ static_cast<unsigned char>(word >> (8 * byte))) * kPrime;
    }
  };
  add(std::uint64_t{window.pv.size()});
  for (const double value : window.pv) add(word_of(value));
  return hash;
}

}  // namespace loopscope::core::signal
