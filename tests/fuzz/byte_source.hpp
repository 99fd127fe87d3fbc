#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

namespace loopscope::tests::fuzz {

/// Makes values out of the bytes of an input, from the front; zeros when they are used up, so that
/// every input means something and a mutation of one byte changes one thing.
class ByteSource {
 public:
  ByteSource(const std::uint8_t* data, std::size_t size) : bytes_(data, size) {}

  [[nodiscard]] bool empty() const { return bytes_.empty(); }
  [[nodiscard]] std::size_t left() const { return bytes_.size(); }

  std::uint8_t byte() { return number<std::uint8_t>(); }
  bool truth() { return (byte() & 1U) != 0; }
  /// 0 to `count` - 1.
  std::size_t below(std::size_t count) { return number<std::uint16_t>() % count; }

  /// The bytes of a number as they are.
  template <typename Number>
  Number number() {
    Number value{};
    const std::size_t taken = bytes_.size() < sizeof value ? bytes_.size() : sizeof value;
    if (taken > 0) std::memcpy(&value, bytes_.data(), taken);
    bytes_ = bytes_.subspan(taken);
    return value;
  }

  /// Up to `most` bytes; the first byte says how many.
  std::string text(std::size_t most) {
    const std::size_t wanted = byte() % (most + 1);
    const std::size_t taken = bytes_.size() < wanted ? bytes_.size() : wanted;
    std::string value(reinterpret_cast<const char*>(bytes_.data()), taken);
    bytes_ = bytes_.subspan(taken);
    return value;
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

}  // namespace loopscope::tests::fuzz
