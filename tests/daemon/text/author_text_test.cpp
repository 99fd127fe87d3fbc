#include "daemon/text/author_text.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

TEST(AuthorText, NamesWhoSpeaksAndBehindItTheLoginThatTheServerNoted) {
  EXPECT_EQ(author_text("ls_engineer", "J. Doe"), "J. Doe (login ls_engineer)");
  EXPECT_EQ(author_text("anna", std::nullopt), "anna");
  EXPECT_EQ(author_text("anna", "anna"), "anna");
}

/// Whoever takes another login's name is told apart from its bearer by what stands last.
TEST(AuthorText, ANameThatLooksLikeALoginDoesNotHideTheLogin) {
  EXPECT_EQ(author_text("ls_engineer", "boss (login boss)"),
            "boss (login boss) (login ls_engineer)");
}

}  // namespace
}  // namespace loopscope::daemon
