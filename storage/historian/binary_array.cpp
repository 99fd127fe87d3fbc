#include "storage/historian/binary_array.hpp"

#include <bit>
#include <cstring>
#include <string>

namespace loopscope::storage {
namespace {

constexpr std::size_t kElementBytes = 8;

/// Takes big-endian numbers from the front of a buffer and never reads behind its end.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::int32_t take_int32() { return static_cast<std::int32_t>(take<std::uint32_t>()); }
  std::uint64_t take_uint64() { return take<std::uint64_t>(); }
  [[nodiscard]] std::size_t left() const { return bytes_.size(); }

 private:
  template <typename Unsigned>
  Unsigned take() {
    if (bytes_.size() < sizeof(Unsigned)) throw MalformedArray("the array ends too early");
    Unsigned value = 0;
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_ = bytes_.subspan(sizeof value);
    if constexpr (std::endian::native == std::endian::big) return value;
    return sizeof value == 4
               ? static_cast<Unsigned>(__builtin_bswap32(static_cast<std::uint32_t>(value)))
               : static_cast<Unsigned>(__builtin_bswap64(value));
  }

  std::span<const std::byte> bytes_;
};

/// Reads the header; returns the number of elements.
std::size_t take_header(Reader& reader, ElementType type) {
  const std::int32_t dimensions = reader.take_int32();
  reader.take_int32();  // has-null flag: the lengths say it again
  const auto found = static_cast<std::uint32_t>(reader.take_int32());
  if (found != static_cast<std::uint32_t>(type)) {
    throw MalformedArray("the array holds type " + std::to_string(found) + " instead of " +
                         std::to_string(static_cast<std::uint32_t>(type)));
  }
  if (dimensions == 0) return 0;
  if (dimensions != 1) throw MalformedArray("the array has several dimensions");
  const std::int32_t size = reader.take_int32();
  reader.take_int32();  // lower bound: the order is all that counts
  // Every element has a length, even NULL: a larger claim would only make us reserve memory.
  if (size < 0 || static_cast<std::size_t>(size) > reader.left() / sizeof(std::int32_t)) {
    throw MalformedArray("the array claims more elements than it holds");
  }
  return static_cast<std::size_t>(size);
}

}  // namespace

std::size_t array_length(std::span<const std::byte> bytes, ElementType type) {
  Reader reader(bytes);
  return take_header(reader, type);
}

std::vector<std::uint64_t> decode_array(std::span<const std::byte> bytes, ElementType type,
                                        std::uint64_t null_bits) {
  Reader reader(bytes);
  std::vector<std::uint64_t> values(take_header(reader, type), null_bits);
  for (std::uint64_t& value : values) {
    const std::int32_t length = reader.take_int32();
    if (length == -1) continue;
    if (length != kElementBytes) throw MalformedArray("an element of the array has a wrong length");
    value = reader.take_uint64();
  }
  if (reader.left() != 0) throw MalformedArray("the array is longer than it says");
  return values;
}

std::uint64_t decode_value(std::span<const std::byte> bytes) {
  if (bytes.size() != kElementBytes) throw MalformedArray("a value has a wrong length");
  return Reader(bytes).take_uint64();
}

}  // namespace loopscope::storage
