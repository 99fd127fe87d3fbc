#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <libpq-fe.h>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "storage/connection_settings.hpp"
#include "storage/explain_error.hpp"
#include "storage/historian/binary_array.hpp"
#include "storage/historian/pq_rows.hpp"
#include "storage/session_setup.hpp"
#include "storage/statement.hpp"

namespace loopscope::storage {

/// Gets an answer of one row.
using TakeRow = std::function<void(const PqRows& row)>;

enum class ResultFormat { text = 0, binary = 1 };

/// The longest name of a table or a column in bytes (PostgreSQL's NAMEDATALEN - 1). A longer one
/// would be cut, and another table be meant.
inline constexpr std::size_t kLongestIdentifier = 63;

/// One libpq connection to a historian: binary results, COPY, and a deadline of our own
/// (patience()), after which the statement is cancelled. Its search path is pg_catalog alone,
/// unless `options` in the connection string sets another one. No statement runs in a session that
/// is not set up (session_setup.hpp). Every function throws DatabaseError (after Remedy::reconnect
/// the object must be thrown away), and std::bad_alloc for an answer that does not fit into memory.
/// Not shared between threads.
class PqConnection {
 public:
  /// Connects and sets the session up.
  explicit PqConnection(const ConnectionSettings& settings);

  /// Runs a statement with its parameters `$1`, `$2`, ... as text, in a transaction of its own
  /// unless one was begun. Refuses (give_up) a number of rows that the statement does not promise.
  PqRows run(const Statement& statement, const std::vector<std::string>& parameters = {},
             ResultFormat format = ResultFormat::text);
  /// The same in binary, a row at a time: `take` gets each as it comes, and only one is in memory.
  /// What it throws is thrown once the answer has ended; what came before may be of an answer that
  /// ends with an error.
  void run_by_row(const Statement& statement, const std::vector<std::string>& parameters,
                  const TakeRow& take);
  /// Runs a COPY ... FROM STDIN in text format; returns the rows written. `next(chunk)` fills a
  /// chunk with whole or partial lines and returns false when there is none left.
  template <typename Next>
  std::size_t copy_in(const Statement& statement, Next next) {
    begin_copy(statement);
    std::string chunk;
    while (next(chunk)) {
      send_copy(chunk);
      chunk.clear();
    }
    return end_copy();
  }

  /// Calls `told` after every statement that was answered: whoever waits for many learns that they
  /// get on.
  void on_statement(std::function<void()> told) { told_ = std::move(told); }

  /// `name` quoted as an identifier. Throws DatabaseError for one that the server would not take
  /// as it is.
  [[nodiscard]] std::string quote(const std::string& name) const;
  /// `text` quoted as a value: for what cannot travel as a parameter. Throws DatabaseError unless
  /// it is UTF-8 without a zero byte.
  [[nodiscard]] std::string quote_literal(const std::string& text) const;
  [[nodiscard]] const std::string& target() const { return place_.target; }
  /// The login's own search path as the text of an array of names, for tables without a schema.
  [[nodiscard]] const std::string& own_schemas() const { return own_schemas_; }

 private:
  using Clock = std::chrono::steady_clock;

  void set_up();
  void send(const std::string& sql, const std::vector<std::string>& parameters,
            ResultFormat format);
  void begin_copy(const Statement& statement);
  void send_copy(std::string_view chunk);
  std::size_t end_copy();
  void start(const Statement& statement);
  /// Sends the session's check and the statement as one pipeline.
  void start_pipeline(const Statement& statement, const std::vector<std::string>& parameters,
                      ResultFormat format);
  void flush();
  PqRows finish();
  /// The last answer of a pipeline; throws the first that is an error. Rows of the statement go to
  /// `take` one by one where there is one.
  PqRows finish_pipeline(const TakeRow& take = nullptr);
  /// An answer of the pipeline, none = the connection broke; with `by_row` those behind the check's
  /// come a row at a time.
  [[nodiscard]] PqRows next_of_pipeline(bool by_row);
  [[nodiscard]] PGresult* await_result();
  [[nodiscard]] PqRows next_result();
  /// Waits until the socket is ready for `events` (poll); throws when the deadline has passed.
  void wait(short events);
  /// Nobody waits for the statement any more.
  [[noreturn]] void give_up();
  [[noreturn]] void fail(const PqRows& error);
  [[noreturn]] void fail(const std::string& message, const std::string& sqlstate);
  [[noreturn]] void fail_connection();

  ConnectionSettings settings_;
  std::unique_ptr<PGconn, PqDelete> connection_;
  ReadySession session_;
  ErrorPlace place_;
  std::string own_schemas_;
  std::optional<std::chrono::seconds> patience_;
  Clock::time_point deadline_;
  std::function<void()> told_;
};

/// Runs `read` and turns bytes that make no sense into an error of the statement.
template <typename Read>
void decode(const PqConnection& connection, const Statement& statement, Read read) {
  try {
    read();
  } catch (const MalformedArray& error) {
    throw DatabaseError(
        std::string(error.what()) + ", statement " + statement.name + ", " + connection.target(),
        "the server answered in a form that this program does not know: report "
        "this with the server's version",
        Remedy::give_up);
  }
}

/// Runs `read(rows)` on the answer, in binary.
template <typename Read>
void run_decoded(PqConnection& connection, const Statement& statement,
                 const std::vector<std::string>& parameters, Read read) {
  const PqRows rows = connection.run(statement, parameters, ResultFormat::binary);
  decode(connection, statement, [&] { read(rows); });
}

/// Runs `read(row)` on each row of the answer as it comes.
template <typename Read>
void run_decoded_by_row(PqConnection& connection, const Statement& statement,
                        const std::vector<std::string>& parameters, Read read) {
  decode(connection, statement, [&] { connection.run_by_row(statement, parameters, read); });
}

}  // namespace loopscope::storage
