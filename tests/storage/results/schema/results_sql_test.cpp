#include "storage/results/schema/results_sql.hpp"

#include <gmock/gmock.h>

#include "tests/support/run_program.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::storage {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(ResultsSql, HoldsTheScriptOfTheRoles) {
  const std::string script = tests::content_of(tests::source_dir() / "deploy" / "roles.sql");
  EXPECT_EQ(roles_script(), script);
  EXPECT_THAT(results_sql({"x", false, {}}),
              HasSubstr(script.substr(script.find("SET search_path"))));
}

TEST(ResultsSql, MakesDatabaseAndLoginsWithoutAPassword) {
  const std::string sql =
      results_sql({"my \"plant", false, {{"o", "loopscope_owner"}, {"w;", "loopscope_worker"}}});
  EXPECT_THAT(sql, StartsWith("CREATE DATABASE \"my \"\"plant\";\n\\connect \"my \"\"plant\"\n"));
  EXPECT_THAT(sql, EndsWith("CREATE ROLE \"o\" LOGIN IN ROLE loopscope_owner;\n"
                            "CREATE ROLE \"w;\" LOGIN IN ROLE loopscope_worker;\n"
                            "\\password \"o\"\n\\password \"w;\"\n"));
  EXPECT_THAT(results_sql({"x", true, {}}), Not(HasSubstr("CREATE DATABASE")));
}

}  // namespace
}  // namespace loopscope::storage
