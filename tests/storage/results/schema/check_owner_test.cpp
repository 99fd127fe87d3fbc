#include "storage/results/schema/check_owner.hpp"

#include <gmock/gmock.h>

#include "tests/storage/results/results_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::HasSubstr;

class CheckOwnerTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!tests::test_server()) GTEST_SKIP() << tests::kNoServer;
  }

  /// The last finding says what can be done.
  static Finding check(const tests::TestDatabase& database, const std::string& login) {
    return check_owner(settings_for(database, login)).back();
  }
};

TEST_F(CheckOwnerTest, AnOwnerMayMakeAndChangeTheSchema) {
  const auto database = database_of_owner();
  const std::string owner = database->make_login("loopscope_owner");
  EXPECT_EQ(check(*database, owner).what,
            owner + " may change the schema loopscope, as migrate, maintain and loops do");
  tests::TestDatabase empty;
  empty.make_roles();
  const Finding maker = check(empty, owner);
  EXPECT_TRUE(maker.ok);
  EXPECT_EQ(maker.what, owner + " may make the schema loopscope in the database " + empty.name());
}

TEST_F(CheckOwnerTest, RolesOfAnotherDatabaseAreNoticed) {
  const auto elsewhere = database_of_owner();
  elsewhere->make_roles();
  const std::string owner = elsewhere->make_login("loopscope_owner");
  tests::TestDatabase database;  // without roles.sql
  const Finding found = check(database, owner);
  EXPECT_FALSE(found.ok);
  EXPECT_THAT(found.what,
              HasSubstr("may not make the schema loopscope in the database " + database.name()));
  EXPECT_THAT(found.hint, HasSubstr("psql -d " + database.name() + " -f deploy/roles.sql"));
}

TEST_F(CheckOwnerTest, AStrangerIsToldWhatToBecome) {
  const auto database = database_of_owner();
  const std::string worker = database->make_login("loopscope_worker");
  const Finding found = check(*database, worker);
  EXPECT_FALSE(found.ok);
  EXPECT_THAT(found.what, HasSubstr(worker + " may not change the schema loopscope"));
  EXPECT_THAT(found.hint, HasSubstr("as a superuser: GRANT "));
}

TEST_F(CheckOwnerTest, WhoDoesNotExistIsAProblem) {
  tests::TestDatabase database;
  const Finding found = check(database, "nobody_of_that_name");
  EXPECT_FALSE(found.ok);
  EXPECT_THAT(found.what, HasSubstr("nobody_of_that_name"));
}

}  // namespace
}  // namespace loopscope::storage
