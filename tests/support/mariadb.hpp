#pragma once

#include <optional>
#include <string>

#include "tests/support/run_program.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::tests {

/// What a test says when it is skipped for want of MariaDB.
inline constexpr const char* kNoMariaDb =
    "no mariadbd or no mysql_fdw (deploy/test installs mariadb-server and postgresql-15-mysql-fdw)";

/// Whether there are a MariaDB to start and a PostgreSQL that can read it.
[[nodiscard]] bool has_mariadb();

/// A MariaDB of its own on a port of the loopback interface, gone at the end; it asks nobody for a
/// password, and its general log is on. Throws std::runtime_error when it does not start.
class MariaDb {
 public:
  MariaDb();
  ~MariaDb();
  MariaDb(const MariaDb&) = delete;
  MariaDb& operator=(const MariaDb&) = delete;

  /// Runs SQL by the program `mariadb` in the database `plant`, its output without names of
  /// columns. Throws std::runtime_error with the server's words.
  std::string execute(const std::string& sql) const;
  /// SQL that makes the foreign server `mariadb` of PostgreSQL, for every login.
  [[nodiscard]] std::string server_sql() const;
  /// Statements that came over a connection since the last call, one a line.
  [[nodiscard]] std::string statements();

 private:
  [[nodiscard]] bool answers() const;

  TemporaryFolder folder_;
  std::string port_;
  std::optional<BackgroundProgram> program_;
  std::size_t told_ = 0;
};

}  // namespace loopscope::tests
