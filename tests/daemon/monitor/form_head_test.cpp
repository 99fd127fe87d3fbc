#include "daemon/monitor/form_head.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

using Lines = std::vector<std::pair<std::string, std::string>>;

const std::pair<std::string, std::string> kForm{"Content-Type",
                                                "application/x-www-form-urlencoded"};

HttpRequest post(Lines lines) {
  HttpRequest request{"/form", {}, "POST"};
  request.headers = std::move(lines);
  return request;
}

/// 0 = it is read.
int refusal(const Lines& lines) {
  const auto head = read_form_head(post(lines));
  const auto* answer = std::get_if<HttpAnswer>(&head);
  return answer == nullptr ? 0 : answer->status;
}

TEST(FormHead, SaysHowLongTheFormIs) {
  const auto head = read_form_head(post({{"content-length", "8192"}, kForm}));
  EXPECT_EQ(std::get<FormHead>(head).bytes, kMostFormBytes);
  EXPECT_FALSE(std::get<FormHead>(head).asks_to_go_on);
  EXPECT_EQ(refusal({{"Content-Length", "0"},
                     {"Content-Type", "Application/X-WWW-Form-URLencoded ; charset=UTF-8"}}),
            0);
  const auto asks =
      read_form_head(post({{"Content-Length", "1"}, kForm, {"Expect", "100-Continue"}}));
  EXPECT_TRUE(std::get<FormHead>(asks).asks_to_go_on);
}

/// Two readers of one head must not disagree about where the next request begins.
TEST(FormHead, ALengthThatCouldBeReadInTwoWaysIsRefused) {
  EXPECT_EQ(refusal({{"Content-Length", "5"}, {"Content-Length", "5"}, kForm}), 400);
  EXPECT_EQ(refusal({{"Content-Length", "5"}, {"Transfer-Encoding", "identity"}, kForm}), 400);
  for (const char* length :
       {"", "-1", "+5", "0x5", "5, 5", "5 ", "5;", "1e3", "99999999999999999999999999"})
    EXPECT_EQ(refusal({{"Content-Length", length}, kForm}), 400) << length;
}

TEST(FormHead, EverythingElseHasItsStatus) {
  EXPECT_EQ(refusal({kForm}), 411);
  EXPECT_EQ(refusal({{"Transfer-Encoding", "chunked"}, kForm}), 411);
  EXPECT_EQ(refusal({{"Content-Length", "8193"}, kForm}), 413);
  EXPECT_EQ(refusal({{"Content-Length", "5"}}), 415);
  EXPECT_EQ(refusal({{"Content-Length", "5"}, kForm, kForm}), 415);
  for (const char* type :
       {"text/plain", "multipart/form-data", "application/x-www-form-urlencoded2"})
    EXPECT_EQ(refusal({{"Content-Length", "5"}, {"Content-Type", type}}), 415) << type;
  EXPECT_EQ(refusal({{"Content-Length", "5"}, kForm, {"Expect", "x"}}), 417);
}

}  // namespace
}  // namespace loopscope::daemon
