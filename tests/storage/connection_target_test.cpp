#include "storage/connection_target.hpp"

#include <fstream>
#include <gmock/gmock.h>

#include "storage/error.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::storage {
namespace {

using testing::HasSubstr;
using tests::EnvironmentVariable;

ConnectionSettings connection_to(const std::string& conninfo) {
  ConnectionSettings settings;
  settings.conninfo = conninfo;
  settings.purpose = "results";
  return settings;
}

TEST(ConnectionTarget, IsWhatLibpqMakesOfIt) {
  const ConnectionTarget target =
      connection_target(connection_to("postgresql://anna@db1:6543/plant"));
  EXPECT_EQ(target.host, "db1");
  EXPECT_EQ(target.port, "6543");
  EXPECT_EQ(target.database, "plant");
  EXPECT_EQ(target.user, "anna");
  EXPECT_EQ(connection_target(connection_to("host=db1,db2 user=a")).host, "db1,db2");
  EXPECT_EQ(connection_target(connection_to("host=db1 user=a")).port, "5432");
  EXPECT_EQ(connection_target(connection_to("hostaddr=10.0.0.1 user=a")).host, "10.0.0.1");
}

TEST(ConnectionTarget, ServicesAreLookedUp) {
  const tests::TemporaryFolder folder;
  std::ofstream(folder.path() / "services") << "[w]\nhost=db9\ndbname=x\nuser=worker\n";
  const EnvironmentVariable file("PGSERVICEFILE", folder.path() / "services");
  const ConnectionTarget target = connection_target(connection_to("service=w"));
  EXPECT_EQ(target.host, "db9");
  EXPECT_EQ(target.user, "worker");
  EXPECT_EQ(connection_target(connection_to("service=w user=owner")).user, "owner");
  try {
    static_cast<void>(connection_target(connection_to("service=none")));
    FAIL();
  } catch (const DatabaseError& error) {
    EXPECT_THAT(error.what(), HasSubstr("definition of service \"none\" not found"));
    EXPECT_EQ(error.remedy(), Remedy::give_up);
  }
}

TEST(ConnectionTarget, ALoginIsPutInAndTheRestStays) {
  EXPECT_TRUE(says_user(connection_to("user=a")));
  EXPECT_TRUE(says_user(connection_to("service=w")));
  EXPECT_FALSE(says_user(connection_to("host=db1")));
  EXPECT_EQ(
      with_user(connection_to("sslmode=verify-full dbname='my plant' host=db1 user=a"), "b c"),
      "host=db1 dbname='my plant' user='b c' sslmode=verify-full");
  EXPECT_EQ(with_user(connection_to("dbname=x"), "it's"), R"(dbname=x user='it\'s')");
  EXPECT_THROW(static_cast<void>(with_user(connection_to("nonsense"), "a")), DatabaseError);
}

}  // namespace
}  // namespace loopscope::storage
