#include "daemon/report/annotate/annotate_form.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

TEST(AnnotateForm, IsItsFieldsWithoutBlanksAround) {
  const auto form = read_annotate_form(
      "token=ab&name=FIC+101%26&deed=suppress&code=any&reason=+a%0D%0Ab%3Cb%3E+&until=2099-01-"
      "01T00%3A00");
  ASSERT_TRUE(form);
  EXPECT_EQ(form->token, "ab");
  EXPECT_EQ(form->loop, "FIC 101&");
  EXPECT_EQ(form->typed.deed, "suppress");
  EXPECT_EQ(form->typed.code, "any");
  EXPECT_EQ(form->typed.reason, "a  b<b>");
  EXPECT_EQ(form->typed.until, "2099-01-01T00:00");
  EXPECT_EQ(form->annotation_id, 0);
  EXPECT_EQ(read_annotate_form("annotation=7")->annotation_id, 7);
}

TEST(AnnotateForm, WhatNoPageSendsIsNone) {
  for (const char* body : {"a=1&a=2", "reason=%ff", "reason=%00", "x=%c0%a7", "annotation=0",
                           "annotation=-1", "annotation=1x", "annotation=99999999999999999999"})
    EXPECT_FALSE(read_annotate_form(body)) << body;
  EXPECT_TRUE(read_annotate_form(""));
}

}  // namespace
}  // namespace loopscope::daemon
