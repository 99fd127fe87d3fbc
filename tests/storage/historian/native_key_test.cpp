#include "storage/historian/native_key.hpp"

#include <gtest/gtest.h>
#include <string>

namespace loopscope::storage {
namespace {

TEST(NativeKey, KeysTravelAsATypeThatTheirColumnsIndexKnows) {
  EXPECT_EQ(key_type("int2"), "int8");
  EXPECT_EQ(key_type("varchar"), "text");
  EXPECT_EQ(key_type("uuid"), "uuid");
  EXPECT_EQ(key_type("bpchar"), "bpchar");
}

TEST(NativeKey, WhatNoRowCanHaveIsNoKey) {
  EXPECT_EQ(native_key("42", "int8"), "42");
  EXPECT_FALSE(native_key("42a", "int8"));
  EXPECT_FALSE(native_key("99999999999999999999", "int8"));
  EXPECT_TRUE(native_key("0a0a0a0a-0000-0000-0000-00000000000F", "uuid"));
  EXPECT_FALSE(native_key("0a0a0a0a-0000-0000-0000-00000000000", "uuid"));
  EXPECT_FALSE(native_key(std::string("a\0b", 3), "text"));
  EXPECT_FALSE(native_key("\xff", "text"));
}

}  // namespace
}  // namespace loopscope::storage
