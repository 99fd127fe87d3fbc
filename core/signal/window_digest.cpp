#include "core/signal/window_digest.hpp"

#include <bit>
#include <cmath>
#include <cstdint>

namespace loopscope::core::signal {
namespace {

/// Fowler, Noll and Vo: offset basis and prime of the 64-bit variant 1a.
constexpr std::uint64_t kOffsetBasis = 14695981039346656037ULL;
constexpr std::uint64_t kPrime = 1099511628211ULL;

class Fnv1a {
 public:
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) add_byte(static_cast<unsigned char>(word >> (8 * byte)));
  }

  void add(double value) {
    // Every missing sample counts the same, and so do both zeros.
    const double canonical = std::isnan(value) ? kMissing : value + 0.0;
    add(std::bit_cast<std::uint64_t>(canonical));
  }

  void add(const Samples& samples) {
    add(std::uint64_t{samples.size()});
    for (const double value : samples) add(value);
  }

  void add(std::string_view text) {
    for (const char c : text) add_byte(static_cast<unsigned char>(c));
  }

  [[nodiscard]] std::uint64_t value() const { return hash_; }

  [[nodiscard]] std::string hexadecimal() const {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text;
    for (int shift = 60; shift >= 0; shift -= 4) text += kDigits[(hash_ >> shift) & 0xF];
    return text;
  }

 private:
  void add_byte(unsigned char byte) { hash_ = (hash_ ^ byte) * kPrime; }

  std::uint64_t hash_ = kOffsetBasis;
};

}  // namespace

std::string window_digest(const LoopWindow& window, std::string_view settings) {
  Fnv1a hash;
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
  Fnv1a hash;
  hash.add(window.pv);
  return hash.value();
}

}  // namespace loopscope::core::signal
