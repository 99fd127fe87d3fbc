#include "storage/historian/setup/check_writer.hpp"

#include <gmock/gmock.h>

#include "tests/storage/historian/historian_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;

using CheckWriterTest = HistorianTest;

TEST_F(CheckWriterTest, ARightThatIsMissingIsNamedWithItsGrant) {
  const std::string writer = database->make_login("");
  const auto check = [&] { return check_writer(settings(writer), layout); };
  EXPECT_THAT(check(),
              Contains(Field(&Finding::what, writer + R"( may not insert into "public")"
                                                      R"(."history", so `import` would fail)")));
  const std::string as_owner = "as the owner: ";
  database->execute(check().back().hint.substr(as_owner.size()));
  EXPECT_TRUE(check().back().ok);
  EXPECT_THAT(check(), Contains(Field(&Finding::what, HasSubstr("may insert into"))));
}

TEST_F(CheckWriterTest, ATableThatIsNotThereYetIsNoProblem) {
  layout.relation = "public.later";
  EXPECT_TRUE(check_writer(settings(), layout).back().ok);
}

TEST_F(CheckWriterTest, WhoCannotConnectIsAFinding) {
  const auto found = check_writer(settings("nobody_of_that_name"), layout);
  EXPECT_FALSE(found.back().ok);
  EXPECT_THAT(found.back().what, HasSubstr("nobody_of_that_name"));
}

}  // namespace
}  // namespace loopscope::storage
