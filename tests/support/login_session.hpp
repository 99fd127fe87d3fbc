#pragma once

#include <memory>
#include <string>

struct pg_conn;

namespace loopscope::tests {

/// A login's own connection, on which everything may be tried.
class LoginSession {
 public:
  /// Throws std::runtime_error with the server's words.
  explicit LoginSession(const std::string& conninfo);

  /// SQLSTATE of a command in a transaction that is thrown away; empty = it was carried out.
  [[nodiscard]] std::string state_of(const std::string& command) const;
  /// The same without a transaction, for commands that refuse to run in one. What it does stays.
  [[nodiscard]] std::string state_of_bare(const std::string& command) const;

 private:
  struct Close {
    void operator()(pg_conn* connection) const;
  };
  std::unique_ptr<pg_conn, Close> connection_;
};

}  // namespace loopscope::tests
