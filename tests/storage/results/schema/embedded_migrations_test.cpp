#include "storage/results/schema/embedded_migrations.hpp"

#include <gtest/gtest.h>
#include <sstream>
#include <string>

#include "tests/support/run_program.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::storage {
namespace {

/// Databases that a migration was applied to refuse every other text of it: a change is a new one.
/// migrations.sha256 is what `sha256sum` prints of each, and grows by a line with each.
TEST(EmbeddedMigrations, ThoseThatWereGivenOutKeepTheirText) {
  std::istringstream kept(
      tests::content_of(tests::source_dir() / "tests/storage/results/migrations.sha256"));
  std::string sha256, file;
  for (const Migration& migration : embedded_migrations()) {
    ASSERT_TRUE(kept >> sha256 >> file) << migration.name << " has no line yet";
    EXPECT_EQ(file, std::string(migration.name) + ".sql");
    EXPECT_EQ(sha256, migration.sha256) << migration.name << " was changed: write a new one";
  }
  EXPECT_FALSE(kept >> sha256);
}

}  // namespace
}  // namespace loopscope::storage
