#include "storage/historian/setup/reader_sql.hpp"

#include "storage/quoted_identifier.hpp"

namespace loopscope::storage {

std::string reader_sql(const ReaderWanted& wanted) {
  const std::string user = quoted_identifier(wanted.user);
  std::string sql;
  if (!wanted.login_exists) sql += "CREATE ROLE " + user + " LOGIN;\n\\password " + user + "\n";
  if (wanted.tables.empty()) {
    return sql +
           "-- Which tables it has to read says the next `loopscope init`, which looks for them.\n";
  }
  for (const std::string& grant : read_grants(wanted.tables, wanted.user, wanted.maker))
    sql += grant + ";\n";
  return sql;
}

}  // namespace loopscope::storage
