#include "storage/results/schema/results_sql.hpp"

#include "storage/quoted_identifier.hpp"

namespace loopscope::storage {
namespace {

/// Without the words about how to run it by itself.
std::string_view roles_statements() {
  const std::string_view script = roles_script();
  return script.substr(script.find("SET search_path"));
}

}  // namespace

std::string results_sql(const ResultsWanted& wanted) {
  const std::string database = quoted_identifier(wanted.database);
  std::string sql;
  if (!wanted.database_exists) sql += "CREATE DATABASE " + database + ";\n";
  sql += "\\connect " + database + "\n\n" + std::string(roles_statements()) + "\n";
  for (const GroupLogin& login : wanted.logins) {
    sql += "CREATE ROLE " + quoted_identifier(login.user) + " LOGIN IN ROLE " + login.group + ";\n";
  }
  for (const GroupLogin& login : wanted.logins)
    sql += "\\password " + quoted_identifier(login.user) + "\n";
  return sql;
}

}  // namespace loopscope::storage
