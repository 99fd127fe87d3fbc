#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace loopscope::storage {

/// deploy/roles.sql, compiled in.
[[nodiscard]] std::string_view roles_script();

/// A login that is to be made, and the group whose rights it gets.
struct GroupLogin {
  std::string user, group;
};

/// What the administrator of the results server is asked for.
struct ResultsWanted {
  std::string database;
  bool database_exists = false;
  std::vector<GroupLogin> logins;
};

/// A script for psql, run as a superuser in any database of the server: the database, the group
/// roles, the logins, whose passwords psql asks for. Every line ends with a line break.
[[nodiscard]] std::string results_sql(const ResultsWanted& wanted);

}  // namespace loopscope::storage
