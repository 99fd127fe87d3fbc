// Arrays in PostgreSQL's binary form: any bytes decode, or throw MalformedArray.

#include <array>

#include "storage/historian/binary_array.hpp"
#include "tests/fuzz/byte_source.hpp"
#include "tests/fuzz/require.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/fuzz/wire.hpp"

namespace loopscope::tests::fuzz {
namespace {

using storage::ElementType;

constexpr std::array kTypes = {ElementType::int8, ElementType::float8, ElementType::timestamp,
                               ElementType::timestamptz};

void check(std::span<const std::byte> bytes, ElementType type) {
  constexpr std::uint64_t kNull = 0x7FF8'0000'0000'0A55;
  const std::size_t length = storage::array_length(bytes, type);
  require(length <= bytes.size() / 4, "no more elements than there are bytes for");
  const std::vector<std::uint64_t> values = storage::decode_array(bytes, type, kNull);
  require(values.size() == length, "as many elements as the header says");
  const Bytes again = array_bytes(type, values, kNull);
  require(storage::decode_array(again, type, kNull) == values, "written and read again");
  require(bytes.size() == again.size() || values.empty(), "one form but for flags");
}

}  // namespace

int fuzz_binary_array(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto bytes = std::as_bytes(std::span(data, size)).subspan(1);
  try {
    check(bytes, kTypes[data[0] % kTypes.size()]);
  } catch (const storage::MalformedArray&) {
    return 0;
  }
  return 0;
}

}  // namespace loopscope::tests::fuzz
