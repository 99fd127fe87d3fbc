#include "storage/historian/binary_array.hpp"

#include <gtest/gtest.h>
#include <initializer_list>
#include <random>

namespace loopscope::storage {
namespace {

using Bytes = std::vector<std::byte>;

void append_int32(Bytes& bytes, std::int32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<std::byte>(static_cast<std::uint32_t>(value) >> shift & 0xFF));
  }
}

void append_int64(Bytes& bytes, std::int64_t value) {
  append_int32(bytes, static_cast<std::int32_t>(static_cast<std::uint64_t>(value) >> 32));
  append_int32(bytes, static_cast<std::int32_t>(static_cast<std::uint64_t>(value) & 0xFFFFFFFFu));
}

Bytes numbers(std::initializer_list<std::int32_t> values) {
  Bytes bytes;
  for (const std::int32_t value : values) append_int32(bytes, value);
  return bytes;
}

/// {7, NULL, -2} as int8[].
Bytes three_elements() {
  Bytes bytes = numbers({1, 1, 20, 3, 1});
  append_int32(bytes, 8);
  append_int64(bytes, 7);
  append_int32(bytes, -1);
  append_int32(bytes, 8);
  append_int64(bytes, -2);
  return bytes;
}

TEST(BinaryArray, ReadsElementsAndNulls) {
  const auto values = decode_array(three_elements(), ElementType::int8, 99);
  EXPECT_EQ(values, (std::vector<std::uint64_t>{7, 99, static_cast<std::uint64_t>(-2)}));
}

TEST(BinaryArray, EmptyArrayHasNoDimension) {
  EXPECT_TRUE(decode_array(numbers({0, 0, 701}), ElementType::float8, 0).empty());
}

TEST(BinaryArray, LengthIsThatOfTheHeader) {
  EXPECT_EQ(array_length(three_elements(), ElementType::int8), 3u);
  EXPECT_EQ(array_length(numbers({0, 0, 701}), ElementType::float8), 0u);
  EXPECT_THROW((void)array_length(numbers({1, 0, 20, 0x7FFFFFFF, 1, 8}), ElementType::int8),
               MalformedArray);
}

TEST(BinaryArray, RefusesAnotherElementType) {
  EXPECT_THROW(decode_array(three_elements(), ElementType::float8, 0), MalformedArray);
}

TEST(BinaryArray, RefusesEveryCutOffPrefix) {
  const Bytes whole = three_elements();
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_THROW(decode_array(std::span(whole).first(length), ElementType::int8, 0), MalformedArray)
        << length;
  }
}

TEST(BinaryArray, RefusesTrailingBytes) {
  Bytes bytes = three_elements();
  bytes.push_back(std::byte{0});
  EXPECT_THROW(decode_array(bytes, ElementType::int8, 0), MalformedArray);
}

TEST(BinaryArray, RefusesSizesThatCannotBe) {
  EXPECT_THROW(decode_array(numbers({1, 0, 20, 0x7FFFFFFF, 1, 8}), ElementType::int8, 0),
               MalformedArray);
  EXPECT_THROW(decode_array(numbers({1, 0, 20, -1, 1}), ElementType::int8, 0), MalformedArray);
  EXPECT_THROW(decode_array(numbers({2, 0, 20, 1, 1, 1, 1, -1}), ElementType::int8, 0),
               MalformedArray);
  EXPECT_THROW(decode_array(numbers({-1, 0, 20}), ElementType::int8, 0), MalformedArray);
  EXPECT_THROW(decode_array(numbers({1, 0, 20, 1, 1, 4, 5}), ElementType::int8, 0), MalformedArray);
  EXPECT_THROW(decode_array(numbers({1, 0, 20, 1, 1, -2}), ElementType::int8, 0), MalformedArray);
}

TEST(BinaryArray, RandomBytesEitherReadOrThrow) {
  std::mt19937 random(1);
  for (int run = 0; run < 20000; ++run) {
    Bytes bytes = three_elements();
    bytes[random() % bytes.size()] = static_cast<std::byte>(random() & 0xFF);
    bytes.resize(random() % (bytes.size() + 1));
    try {
      EXPECT_LE(decode_array(bytes, ElementType::int8, 0).size(), bytes.size() / 4);
    } catch (const MalformedArray&) {
      continue;
    }
  }
}

TEST(BinaryValue, HasEightBytes) {
  EXPECT_EQ(decode_value(numbers({1, 2})), 0x0000000100000002u);
  EXPECT_THROW(static_cast<void>(decode_value(numbers({1}))), MalformedArray);
  EXPECT_THROW(static_cast<void>(decode_value(numbers({1, 2, 3}))), MalformedArray);
}

}  // namespace
}  // namespace loopscope::storage
