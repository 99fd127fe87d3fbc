#include "tests/support/template_database.hpp"

#include "tests/support/sql_connection.hpp"

namespace loopscope::tests {
namespace {

bool exists(const auto& server, const std::string& database) {
  return !server.run("SELECT FROM pg_database WHERE datname = '" + database + "'").empty();
}

/// Has its name only when it is whole: one that was being made when its process died is made anew.
/// Nobody can connect to it, since it could not be copied meanwhile; the server waits for the
/// sessions that filled it to be gone.
void make(const SqlConnection& server, const std::string& conninfo,
          const TemplateDatabase& filled) {
  const std::string unfinished = filled.name + "_unfinished";
  server.run("DROP DATABASE IF EXISTS " + unfinished + " WITH (FORCE)");
  server.run("CREATE DATABASE " + unfinished + " TEMPLATE template0 ENCODING 'UTF8'");
  filled.fill(with_key(conninfo, "dbname", unfinished));
  server.run("ALTER DATABASE " + unfinished + " WITH ALLOW_CONNECTIONS false");
  server.run("ALTER DATABASE " + unfinished + " RENAME TO " + filled.name);
}

/// The lock is the session's and ends with it.
void make_once(const std::string& conninfo, const TemplateDatabase& filled) {
  const SqlConnection server(conninfo);
  server.run("SELECT pg_advisory_lock(hashtext('" + filled.name + "'))");
  if (!exists(server, filled.name)) make(server, conninfo, filled);
}

/// What ALTER DATABASE has set belongs to the database's name, not to what is copied.
void copy_settings(const ReusedConnection& server, const std::string& from, const std::string& to) {
  const TextRows settings = server.run(
      "SELECT split_part(entry, '=', 1), quote_literal(substr(entry, strpos(entry, '=') + 1))"
      " FROM pg_db_role_setting JOIN pg_database ON pg_database.oid = setdatabase,"
      " unnest(setconfig) AS entry WHERE setrole = 0 AND datname = '" +
      from + "'");
  for (const auto& row : settings) {
    server.run("ALTER DATABASE " + to + " SET " + row[0] + " = " + row[1]);
  }
}

}  // namespace

std::string copy_strategy(const ReusedConnection& server) {
  const bool can_choose = std::stoi(server.run("SHOW server_version_num")[0][0]) >= 150'000;
  return can_choose ? " STRATEGY file_copy" : "";
}

void copy_template(const ReusedConnection& server, const std::string& conninfo,
                   const TemplateDatabase& filled, const std::string& database) {
  if (!exists(server, filled.name)) make_once(conninfo, filled);
  server.run("CREATE DATABASE " + database + " TEMPLATE " + filled.name + copy_strategy(server));
  copy_settings(server, filled.name, database);
}

}  // namespace loopscope::tests
