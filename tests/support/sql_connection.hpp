#pragma once

#include <memory>
#include <string>
#include <vector>

struct pg_conn;

namespace loopscope::tests {

/// Rows of a query as text; NULL is "NULL", unless another word was asked for.
using TextRows = std::vector<std::vector<std::string>>;

/// A connection that goes by another way than the program's, so that a test does not check the
/// program by itself.
class SqlConnection {
 public:
  /// What fails is told by the first statement.
  explicit SqlConnection(const std::string& conninfo);

  /// Runs one or several commands; the rows are the last one's.
  /// @throws std::runtime_error with the server's words
  // NOLINTNEXTLINE(modernize-use-nodiscard): of most commands no rows are expected
  TextRows run(const std::string& sql, const std::string& null_text = "NULL") const;

  /// False when the server has ended it, as far as has been heard of it, or a transaction is open.
  [[nodiscard]] bool is_idle() const;

 private:
  struct Close {
    void operator()(pg_conn* connection) const;
  };
  std::unique_ptr<pg_conn, Close> connection_;
};

/// `conninfo` with another value for one of its keys: libpq takes the last of equal ones.
[[nodiscard]] std::string with_key(const std::string& conninfo, const std::string& key,
                                   const std::string& value);

}  // namespace loopscope::tests
