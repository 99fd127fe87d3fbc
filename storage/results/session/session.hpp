#pragma once

#include <atomic>
#include <pqxx/pqxx>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "storage/connection_settings.hpp"
#include "storage/error.hpp"
#include "storage/explain_error.hpp"
#include "storage/results/session/socket_deadline.hpp"
#include "storage/session_setup.hpp"
#include "storage/statement.hpp"

namespace loopscope::storage {

inline constexpr const char* kReadWrite = "BEGIN";
inline constexpr const char* kOneMoment = "BEGIN ISOLATION LEVEL REPEATABLE READ, READ ONLY";

/// A transaction that begins, in the same message, with the check of its session: where that fails,
/// nothing else is done in it. Commits as pqxx::work does.
class CheckedTransaction : public pqxx::internal::basic_transaction {
 public:
  CheckedTransaction(pqxx::connection_base& connection, const char* begin,
                     const std::string& check_sql)
      : pqxx::internal::namedclass("transaction"),
        basic_transaction(connection, "READ COMMITTED", pqxx::read_write),
        begin_(std::string(begin) + "; " + check_sql) {
    Begin();
  }
  ~CheckedTransaction() override { End(); }
  CheckedTransaction(const CheckedTransaction&) = delete;
  CheckedTransaction& operator=(const CheckedTransaction&) = delete;

 private:
  void do_begin() override { direct_exec(begin_.c_str()); }

  std::string begin_;
};

/// An open transaction of a Session. Its functions throw libpqxx's exceptions and DatabaseError,
/// for Session::transact() to explain: nothing of them is to be caught within.
class Transaction {
 public:
  /// Runs a statement with its parameters `$1`, `$2`, ... as text. Throws DatabaseError (give_up)
  /// when the number of rows is not the one that the statement promises.
  pqxx::result run(const Statement& statement, const std::vector<std::string>& parameters = {});
  /// Runs a script of several commands (a migration); `name` is that of messages.
  void run_script(const char* name, const char* sql);
  /// As whom the connection was made, whatever the session is by now.
  [[nodiscard]] std::string login() const { return work_.conn().username(); }

 private:
  friend class Session;
  friend class Snapshot;
  Transaction(pqxx::transaction_base& work, std::string& statement, SocketDeadline& deadline)
      : work_(work), statement_(statement), deadline_(deadline) {}
  pqxx::result execute(const Statement& statement, const std::vector<std::string>& parameters);
  void keep_plans(bool keep);

  pqxx::transaction_base& work_;
  std::string& statement_;  // the session's, for the message should it fail
  SocketDeadline& deadline_;
  bool keeps_plans_ = false;
};

/// One connection to the results database and the only place that knows libpqxx's exceptions.
/// Every transaction begins with the check of its session (session_setup.hpp); a statement whose
/// time is over is cancelled.
///
/// libpqxx 6.4 reconnects by itself on the third use of a broken connection and has lost the
/// session by then: after the first broken use every later one is refused here (Remedy::reconnect).
/// Not shared between threads.
class Session {
 public:
  /// Connects, and refuses a schema that is not to be trusted: enter_schema(). Throws
  /// DatabaseError.
  explicit Session(const ConnectionSettings& settings);

  /// Runs `work(Transaction&)` in one transaction, commits it and returns what work returned.
  /// Throws DatabaseError, or what is no database's error as work threw it; then nothing was
  /// stored, except with the SQLSTATE kOutcomeUnknown. Each statement waits patience() at most.
  template <typename Work>
  auto transact(Work&& work) {
    return watched("begin", [&] {
      CheckedTransaction transaction(connection_, kReadWrite, session_.check_sql);
      Transaction facade(transaction, statement_, deadline_);
      if constexpr (std::is_void_v<decltype(work(facade))>) {
        work(facade);
        commit(transaction);
      } else {
        auto result = work(facade);
        commit(transaction);
        return result;
      }
    });
  }

 private:
  friend class Snapshot;

  /// Everything that speaks with the server goes through here: under a deadline that also covers
  /// what libpqxx does by itself (the beginning of a transaction, its rollback), with its
  /// exceptions put into an operator's words.
  template <typename Work>
  auto watched(const char* first_statement, Work&& work) {
    refuse_if_dead();
    statement_ = first_statement;
    const SocketDeadline::Guard guard(deadline_);
    try {
      return work();
    } catch (...) {
      explain_current_exception();
    }
  }
  void set_up();
  void commit(pqxx::dbtransaction& transaction);
  void refuse_if_dead() const;
  [[noreturn]] void explain_current_exception();
  [[noreturn]] void fail(const std::string& message, const std::string& sqlstate,
                         bool connection_lost);

  ConnectionSettings settings_;
  ErrorPlace place_;
  ReadySession session_;
  std::atomic<int> process_ = 0;  ///< that of session_, for the watch of the deadline
  std::string statement_;
  bool dead_ = false;
  pqxx::connection connection_;
  /// What the server remarks beside its answers would go to standard error line by line; errors
  /// come as exceptions.
  pqxx::quiet_errorhandler quiet_{connection_};
  SocketDeadline deadline_;
};

}  // namespace loopscope::storage
