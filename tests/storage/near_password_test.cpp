#include "storage/near_password.hpp"

#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/source_dir.hpp"

namespace loopscope::storage {
namespace {

/// The part that differs, "dbname=plant"; empty = nothing is near.
std::string near_to(const ConnectionTarget& target, const std::string& lines) {
  const tests::TemporaryFolder folder;
  ConnectionTarget with_file = target;
  with_file.password_file = folder.path() / "pgpass";
  std::ofstream(with_file.password_file) << lines;
  const auto near = find_near_password(with_file);
  return near ? near->part + "=" + near->other : "";
}

TEST(NearPassword, OnePartMayDifferThoughNotTheLogin) {
  const ConnectionTarget target{"db2", "5432", "plnt", "reader"};
  EXPECT_EQ(near_to(target, "db2:5432:plant:reader:geheim\n"), "dbname=plant");
  EXPECT_EQ(near_to(target, "db1:*:plnt:reader:geheim\n"), "host=db1");
  EXPECT_EQ(near_to(target, "*:5433:plnt:reader:geheim\n"), "port=5433");
  EXPECT_EQ(near_to(target, "db2:5432:plnt:writer:geheim\n"), "");
  EXPECT_EQ(near_to(target, "db1:5432:plant:reader:geheim\n"), "");
  EXPECT_EQ(near_to(target, "# db2:5432:plant:reader:geheim\n\ndb2:5432:plant:reader\n"), "");
}

TEST(NearPassword, AllOfTheLineFitsInAFileThatIsIgnored) {
  EXPECT_EQ(near_to({"db2", "5432", "plnt", "reader"},
                    "db2:5432:plant:reader:geheim\n*:*:plnt:reader:geheim\n"),
            "=");
}

TEST(NearPassword, EscapesAreReadAndTheUsualSocketIsTheLocalHost) {
  EXPECT_EQ(near_to({"::1", "5432", "x", "a:b"}, "\\:\\:1:5432:y\\\\z:a\\:b:geheim\n"),
            "dbname=y\\z");
  EXPECT_EQ(near_to({"", "5432", "x", "a"}, "localhost:5432:y:a:geheim\n"), "dbname=y");
  EXPECT_EQ(near_to({"/run", "5432", "x", "a"}, "/run:5432:y:a:geheim\n"), "dbname=y");
}

TEST(NearPassword, WithoutAFileThereIsNone) {
  EXPECT_FALSE(find_near_password({"db", "5432", "x", "a", "/nowhere/pgpass"}));
  EXPECT_FALSE(find_near_password({"db", "5432", "x", "a"}));
}

}  // namespace
}  // namespace loopscope::storage
