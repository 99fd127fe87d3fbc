#include "daemon/catalogue/on_behalf_of.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/text/failure.hpp"
#include "daemon/text/printable.hpp"
#include "tests/support/hostile_names.hpp"
#include "tests/support/run_program.hpp"

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;
using tests::HostileName;

/// What is said of a name that is refused; empty = it is taken, as it is.
std::string complaint_about(const std::string& name) {
  try {
    EXPECT_EQ(on_behalf_of(name), name);
    return "";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::usage);
    EXPECT_THAT(failure.hint(), HasSubstr("leave the option out"));
    return failure.what();
  }
}

std::string umlauts(std::size_t count) {
  std::string text;
  for (std::size_t k = 0; k < count; ++k) text += "\u00fc";
  return text;
}

TEST(OnBehalfOf, NamesOfPeopleAreTaken) {
  for (const char* name : {"J. Doe", "J\u00fcrgen M\u00fcller", "\u738b\u4f1f", "PLANT\\jdoe",
                           "O'Brien <o@example.com>", "\u0645\u06cc\u200c\u062e"})
    EXPECT_EQ(complaint_about(name), "");
  EXPECT_EQ(complaint_about(umlauts(200)), "");
}

TEST(OnBehalfOf, WhatIsNoNameIsRefusedInWords) {
  EXPECT_EQ(complaint_about(""), "--on-behalf-of is empty");
  EXPECT_EQ(complaint_about(" "), "--on-behalf-of \" \" has blanks around the name");
  EXPECT_EQ(complaint_about("J. Doe "), "--on-behalf-of \"J. Doe \" has blanks around the name");
  EXPECT_EQ(complaint_about(umlauts(201)), "--on-behalf-of has 201 characters, 200 are the most");
  for (const char* blank : {"\u00a0anna", "anna\u3000", "\u2003anna"})
    EXPECT_THAT(complaint_about(blank), HasSubstr("has blanks around the name")) << blank;
  for (const char* filler : {"\u3164", "an\u3164na", "anna\u00ad", "\u2800"})
    EXPECT_THAT(complaint_about(filler), HasSubstr("characters that show nothing")) << filler;
  EXPECT_EQ(printable(complaint_about("J.\nDoe")),
            "--on-behalf-of \"J.\\x0aDoe\" is not one line of printable text");
}

TEST(OnBehalfOf, AHostileNameIsTakenAsItIsOrRefused) {
  for (const auto* names : {&tests::hostile_names(), &tests::impossible_names()}) {
    for (const HostileName& hostile : *names) {
      const std::string& name = hostile.name;
      const bool is_name = printable(name) == name && name.front() != ' ' && name.back() != ' ' &&
                           !name.ends_with("\u00a0") && name.size() <= 200;
      EXPECT_EQ(complaint_about(name).empty(), is_name) << hostile.about << ": " << name;
    }
  }
}

/// What `id` says.
TEST(OnBehalfOf, WithoutTheOptionItIsTheSystemsUser) {
  const std::string id = tests::run_program({"/usr/bin/id", "-run"}).out;
  EXPECT_EQ(on_behalf_of(std::nullopt).value_or("") + "\n", id);
}

}  // namespace
}  // namespace loopscope::daemon
