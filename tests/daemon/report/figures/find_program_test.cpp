#include "daemon/report/figures/find_program.hpp"

#include <gtest/gtest.h>

#include "tests/support/source_dir.hpp"

namespace loopscope::daemon {
namespace {

TEST(FindProgram, LooksThroughThePathAndOnlyThere) {
  EXPECT_EQ(find_program("sh", "/nonexistent:/bin"), "/bin/sh");
  EXPECT_EQ(find_program("sh", ""), std::nullopt);
  EXPECT_EQ(find_program("sh", ":."), std::nullopt);
  EXPECT_EQ(find_program("no-such-program", "/bin:/usr/bin"), std::nullopt);
}

// As a service that was started with root's PATH meets one. A link to itself cannot be looked into
// by root either.
TEST(FindProgram, AFolderThatCannotBeLookedIntoHasNone) {
  const tests::TemporaryFolder folder;
  const std::string closed = folder.path() / "closed";
  std::filesystem::create_symlink("closed", closed);
  EXPECT_EQ(find_program("sh", closed + ":/bin"), "/bin/sh");
  EXPECT_EQ(find_program("sh", closed), std::nullopt);
}

}  // namespace
}  // namespace loopscope::daemon
