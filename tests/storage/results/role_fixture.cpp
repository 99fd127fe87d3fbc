#include "tests/storage/results/role_fixture.hpp"

#include <gmock/gmock.h>

namespace loopscope::storage {

using testing::AnyOf;
using testing::IsEmpty;
using testing::Not;
using tests::LoginSession;

void RoleTest::SetUp() {
  if (!tests::test_server()) GTEST_SKIP() << tests::kNoServer;
  database = database_of_owner();
  owner = database->make_login("loopscope_owner");
  worker = database->make_login("loopscope_worker");
  reader = database->make_login("loopscope_reader");
  engineer = database->make_login("loopscope_engineer");
  historian = database->make_login("loopscope_historian");
  stranger = database->make_login("");
  Catalogue(settings_for(*database, owner)).save(std::vector{loop_named("a")});
  database->execute(
      "CREATE SCHEMA site; CREATE TABLE site.history (tag text, time timestamptz, value real,"
      " quality int); CREATE TABLE site.payroll (name text, pay int);"
      "CREATE TABLE public.other (x int); CREATE SEQUENCE site.numbers;"
      "CREATE FUNCTION site.secret() RETURNS int LANGUAGE sql AS 'SELECT 1';"
      "REVOKE ALL ON FUNCTION site.secret() FROM PUBLIC;"
      "GRANT USAGE ON SCHEMA site TO loopscope_historian;"
      "GRANT SELECT ON site.history TO loopscope_historian");
}

void RoleTest::expect_state(const LoginSession& session, const std::string& command, bool allowed) {
  const std::string state = session.state_of(command);
  if (allowed) {
    EXPECT_NE(state, kRefused) << command;
  } else {
    EXPECT_THAT(state, AnyOf(kRefused, kNotUpdatable)) << command;
  }
}

tests::TextRows RoleTest::relations(const std::string& schema) const {
  tests::TextRows found = database->rows(
      "SELECT relname, relkind = 'v', relispartition FROM pg_class WHERE relkind IN"
      " ('r', 'p', 'v', 'm', 'f') AND relnamespace = '" +
      schema + "'::regnamespace ORDER BY relname");
  EXPECT_THAT(found, Not(IsEmpty())) << "whoever walks through them would find no fault";
  return found;
}

std::vector<std::string> RoleTest::columns(const std::string& relation) const {
  std::vector<std::string> names;
  for (const auto& row :
       database->rows("SELECT attname FROM pg_attribute WHERE attrelid = '" + relation +
                      "'::regclass AND attnum > 0 AND NOT attisdropped"))
    names.push_back(row[0]);
  EXPECT_THAT(names, Not(IsEmpty())) << relation;
  return names;
}

std::vector<std::string> ddl_on(const std::string& relation, bool view) {
  const std::string kind = view ? "VIEW " : "TABLE ";
  std::vector<std::string> commands{
      "DROP " + kind + relation, "ALTER " + kind + relation + " RENAME TO stolen",
      "ALTER " + kind + relation + " OWNER TO CURRENT_USER",
      "COMMENT ON " + kind + relation + " IS 'x'",
      "CREATE RULE r AS ON INSERT TO " + relation + " DO INSTEAD NOTHING"};
  if (view) return commands;
  for (const char* command :
       {"TRUNCATE %", "ALTER TABLE % ADD COLUMN planted int", "ALTER TABLE % DISABLE TRIGGER ALL",
        "ALTER TABLE % ENABLE ROW LEVEL SECURITY", "CREATE POLICY p ON % USING (true)",
        "CREATE INDEX ON % ((1))", "REINDEX TABLE %", "LOCK TABLE % IN ACCESS EXCLUSIVE MODE",
        ("CREATE TRIGGER t BEFORE INSERT ON % EXECUTE FUNCTION"
         " suppress_redundant_updates_trigger()")}) {
    std::string text = command;
    commands.push_back(text.replace(text.find('%'), 1, relation));
  }
  return commands;
}

}  // namespace loopscope::storage
