#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/reused_connection.hpp"
#include "tests/support/template_database.hpp"

namespace loopscope::tests {

/// Connection string (superuser) of the throw-away server that ctest starts for tests with the
/// label `server`, or that tests/support/postgres started by hand; nullopt when there is none.
[[nodiscard]] std::optional<std::string> test_server();

/// deploy/roles.sql, which makes the group roles.
[[nodiscard]] std::string roles_script();

/// Makes the group roles, with their rights in the database of `conninfo` (a superuser's), and a
/// login of the owner's group, which all tests share: the program takes no superuser. Its name.
std::string make_owner(const std::string& conninfo);

/// What a test says when it is skipped for want of a server.
inline constexpr const char* kNoServer =
    "no PostgreSQL server: run the test by ctest, which starts one";

/// A fresh database on the throw-away server, dropped at the end with the logins made for it. Every
/// function throws std::runtime_error with the server's words.
class TestDatabase {
 public:
  /// `encoding` is that of the database, e.g. "UTF8" or "LATIN1".
  explicit TestDatabase(const std::string& encoding = "UTF8");
  /// A copy; it is filled once on the server.
  explicit TestDatabase(const TemplateDatabase& filled);
  ~TestDatabase();
  TestDatabase(const TestDatabase&) = delete;
  TestDatabase& operator=(const TestDatabase&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }
  /// Connection string as the superuser, or as `user`.
  [[nodiscard]] std::string conninfo() const;
  [[nodiscard]] std::string conninfo(const std::string& user) const;

  void make_roles() const;
  /// As make_owner().
  [[nodiscard]] std::string owner() const;
  /// Makes a login that is a member of `group` (empty = of none) and returns its name.
  std::string make_login(const std::string& group);

  /// Runs one or several commands; what they set for their session ends with them.
  void execute(const std::string& sql) const;
  [[nodiscard]] TextRows rows(const std::string& sql, const std::string& null_text = "NULL") const;
  /// First column of the only row.
  [[nodiscard]] std::string value(const std::string& sql) const;

 private:
  std::string name_;
  std::vector<std::string> logins_;
  mutable std::once_flag roles_;
  mutable std::string owner_;
  ReusedConnection connection_;
};

}  // namespace loopscope::tests
