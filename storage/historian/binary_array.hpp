#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace loopscope::storage {

/// Type numbers of PostgreSQL's catalogue (src/include/catalog/pg_type.dat): fixed for good.
enum class ElementType : std::uint32_t {
  int8 = 20,
  float8 = 701,
  timestamp = 1114,
  timestamptz = 1184,
};

/// Bytes that are no array of the expected type.
class MalformedArray : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The elements of a one-dimensional array in binary form, eight bytes each, as raw bits in the
/// machine's byte order; `null_bits` stands for NULL. Throws MalformedArray.
///
/// The form (array_send in PostgreSQL's arrayfuncs.c), all numbers big-endian: int32 dimensions
/// (0 = empty), int32 has-null flag, int32 element type; per dimension int32 size, int32 lower
/// bound; per element int32 length (-1 = NULL) and that many bytes.
[[nodiscard]] std::vector<std::uint64_t> decode_array(std::span<const std::byte> bytes,
                                                      ElementType type, std::uint64_t null_bits);

/// How many elements such an array has; they are not looked at. Throws MalformedArray.
[[nodiscard]] std::size_t array_length(std::span<const std::byte> bytes, ElementType type);

/// A single eight-byte value in binary form. Throws MalformedArray.
[[nodiscard]] std::uint64_t decode_value(std::span<const std::byte> bytes);

}  // namespace loopscope::storage
