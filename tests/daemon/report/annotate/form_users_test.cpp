#include "daemon/report/annotate/form_users.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

namespace loopscope::daemon {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::MatchesRegex;
using namespace std::chrono_literals;

class FormUsersTest : public testing::Test {
 protected:
  FormUsers::Clock::time_point now{};
  FormUsers users{[this] { return now; }};
};

TEST_F(FormUsersTest, ATokenIsLongAtRandomAndCountsOnce) {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(users.new_token("anna", "FIC101"));
  EXPECT_EQ(tokens.size(), 100U);
  const std::string token = users.new_token("anna", "FIC101");
  EXPECT_THAT(token, MatchesRegex("[0-9a-f]{64}"));
  EXPECT_TRUE(users.take_token("anna", "FIC101", token));
  EXPECT_FALSE(users.take_token("anna", "FIC101", token));
}

TEST_F(FormUsersTest, ATokenIsOfOneUserAndLoop) {
  const std::string token = users.new_token("anna", "FIC101");
  EXPECT_FALSE(users.take_token("ben", "FIC101", token));
  EXPECT_FALSE(users.take_token("anna", "FIC102", token));
  for (const std::string& wrong :
       {std::string(), std::string(64, '0'), token.substr(1), token + '0'})
    EXPECT_FALSE(users.take_token("anna", "FIC101", wrong)) << wrong;
  EXPECT_TRUE(users.take_token("anna", "FIC101", token));
}

TEST_F(FormUsersTest, ATokenAges) {
  const std::string token = users.new_token("anna", "FIC101");
  const std::string other = users.new_token("anna", "FIC101");
  now += FormUsers::kTokenLife;
  EXPECT_TRUE(users.take_token("anna", "FIC101", token));
  now += 1s;
  EXPECT_FALSE(users.take_token("anna", "FIC101", other));
}

TEST_F(FormUsersTest, NobodyPushesOutWhatBelongsToAnother) {
  const std::string token = users.new_token("anna", "FIC101");
  for (int i = 0; i < 10'000; ++i) static_cast<void>(users.new_token("eve", "FIC101"));
  EXPECT_TRUE(users.take_token("anna", "FIC101", token));
  const std::string first = users.new_token("anna", "FIC101");
  for (std::size_t i = 0; i < FormUsers::kMostTokens; ++i)
    static_cast<void>(users.new_token("anna", "FIC101"));
  EXPECT_FALSE(users.take_token("anna", "FIC101", first));
}

TEST_F(FormUsersTest, OfManyUsersTheOneWhoWasAwayLongestIsForgotten) {
  const std::string old = users.new_token("anna", "FIC101");
  now += 1s;
  const std::string newer = users.new_token("ben", "FIC101");
  now += 1s;
  for (std::size_t i = 0; i + 1 < FormUsers::kMostUsers; ++i)
    static_cast<void>(users.new_token("u" + std::to_string(i), "FIC101"));
  EXPECT_TRUE(users.take_token("ben", "FIC101", newer));
  EXPECT_FALSE(users.take_token("anna", "FIC101", old));
}

TEST_F(FormUsersTest, WritesOfAMinuteAreCounted) {
  for (std::size_t i = 0; i < FormUsers::kMostWrites; ++i) EXPECT_TRUE(users.may_write("anna"));
  EXPECT_FALSE(users.may_write("anna"));
  EXPECT_TRUE(users.may_write("ben"));
  now += FormUsers::kWriteSpan;
  EXPECT_TRUE(users.may_write("anna"));
}

TEST_F(FormUsersTest, WhatIsToldIsToldOnceOfItsLoop) {
  users.tell("anna", "FIC101", {"one", "two"});
  EXPECT_THAT(users.told("ben", "FIC101"), IsEmpty());
  EXPECT_THAT(users.told("anna", "FIC102"), IsEmpty());
  EXPECT_THAT(users.told("anna", "FIC101"), ElementsAre("one", "two"));
  EXPECT_THAT(users.told("anna", "FIC101"), IsEmpty());
}

}  // namespace
}  // namespace loopscope::daemon
