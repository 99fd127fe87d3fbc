#include "storage/historian/setup/reader_sql.hpp"

#include <gtest/gtest.h>

namespace loopscope::storage {
namespace {

TEST(ReaderSql, IsTheLoginAndTwoGrants) {
  EXPECT_EQ(reader_sql({"reader", false, {{"site", "history"}, {"site", "tags"}}, ""}),
            "CREATE ROLE \"reader\" LOGIN;\n"
            "\\password \"reader\"\n"
            "GRANT USAGE ON SCHEMA \"site\" TO \"reader\";\n"
            "GRANT SELECT ON \"site\".\"history\", \"site\".\"tags\" TO \"reader\";\n");
}

TEST(ReaderSql, NamesAreQuoted) {
  EXPECT_EQ(reader_sql({"a\"; DROP ROLE b", true, {{"s\"", "t;"}}, ""}),
            "GRANT USAGE ON SCHEMA \"s\"\"\" TO \"a\"\"; DROP ROLE b\";\n"
            "GRANT SELECT ON \"s\"\"\".\"t;\" TO \"a\"\"; DROP ROLE b\";\n");
}

TEST(ReaderSql, ATableAMonthIsGrantedBeforeItIsMade) {
  EXPECT_EQ(reader_sql({"reader", true, {{"public", "sqlth_te"}}, "gateway"}),
            "GRANT USAGE ON SCHEMA \"public\" TO \"reader\";\n"
            "GRANT SELECT ON ALL TABLES IN SCHEMA \"public\" TO \"reader\";\n"
            "ALTER DEFAULT PRIVILEGES FOR ROLE \"gateway\" IN SCHEMA \"public\" GRANT SELECT ON "
            "TABLES TO \"reader\";\n");
}

TEST(ReaderSql, WithoutTablesTheNextRunIsNamed) {
  EXPECT_EQ(reader_sql({"reader", false, {}, ""}),
            "CREATE ROLE \"reader\" LOGIN;\n\\password \"reader\"\n"
            "-- Which tables it has to read says the next `loopscope init`, which looks for "
            "them.\n");
}

}  // namespace
}  // namespace loopscope::storage
