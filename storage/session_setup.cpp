#include "storage/session_setup.hpp"

#include "storage/error.hpp"
#include "storage/lost_session.hpp"
#include "storage/query_once.hpp"

namespace loopscope::storage {
namespace {

const Statement kProcess{"session_process", "SELECT pg_catalog.pg_backend_pid()", Rows::one};

/// Whatever standard_conforming_strings says: it is the login's until the session is set up.
std::string literal(const std::string& text) {
  std::string quoted = "E'";
  for (const char character : text) {
    if (character == '\'' || character == '\\') quoted += character;
    quoted += character;
  }
  return quoted + "'";
}

/// In the session of this process and in no other; returns what the server makes of the values
/// ("60s" is "1min").
Statement set_statement(const SessionSettings& settings, int process) {
  std::string columns;
  for (const auto& [name, value] : settings) {
    columns += (columns.empty() ? "" : ", ") + ("pg_catalog.set_config(" + literal(name)) + ", " +
               literal(value) + ", false)";
  }
  return {kSettingStatement, "SELECT " + columns +
                                 " WHERE pg_catalog.pg_backend_pid() OPERATOR(pg_catalog.=) " +
                                 std::to_string(process)};
}

/// The server's message of the failed cast names what does not hold. CASE asks in this order.
std::string check_of(const SessionSettings& settings, const std::vector<std::string>& values) {
  std::string cases;
  std::size_t column = 0;
  for (const auto& [name, value] : settings) {
    cases += " WHEN COALESCE(pg_catalog.current_setting(" + literal(name) +
             ", true), '') OPERATOR(pg_catalog.<>) " + literal(values[column++]) + " THEN " +
             literal(kLostMark + name + kLostMarkEnd);
  }
  return "SELECT CAST(CASE" + cases + " ELSE '1' END AS pg_catalog.int4)";
}

/// Prepared, since to take its text apart would cost more than to run it. No other session has a
/// statement of this name.
ReadySession with_check(int process, const SessionSettings& settings,
                        const std::vector<std::string>& values, const AskRow& ask) {
  const std::string name = kCheckName + std::to_string(process);
  ask({"prepare_check", "PREPARE " + name + " AS " + check_of(settings, values), Rows::none});
  return {process, "EXECUTE " + name};
}

DatabaseError came_to_two_sessions(const ConnectionSettings& settings) {
  return lends_sessions("two transactions of one client came to two sessions, " +
                        describe_target(settings));
}

int ask_process(const AskRow& ask) {
  return std::stoi(ask(kProcess).front());
}

/// A pooler that lends by transaction has the session free in this moment, and gives the one that
/// was used last to whoever asks next, or its sessions in turn: then the second question here comes
/// to another one. Among many busy clients both may be missed; the check is not.
int kept_process(const ConnectionSettings& settings, const AskRow& ask) {
  const int process = ask_process(ask);
  const auto of_another_client = query_once(settings, kProcess.sql);
  if (of_another_client == std::to_string(process)) {
    throw lends_sessions("another client was given the same session meanwhile, " +
                         describe_target(settings));
  }
  if (ask_process(ask) != process) throw came_to_two_sessions(settings);
  return process;
}

/// In the next transaction; what is lost by then will be lost again.
void read_back(const ReadySession& ready, const AskRow& ask) {
  try {
    ask({"check_session", ready.check_sql, Rows::one});
  } catch (const DatabaseError& error) {
    if (error.sqlstate() != kLostSession) throw;
    throw lends_sessions(error.what());
  }
}

ReadySession set_up_pooled(const ConnectionSettings& settings, const AskRow& ask) {
  const SessionSettings wanted = session_settings(settings);
  const int process = kept_process(settings, ask);
  const std::vector<std::string> values = ask(set_statement(wanted, process));
  if (values.empty()) throw came_to_two_sessions(settings);
  ReadySession ready = with_check(process, wanted, values, ask);
  read_back(ready, ask);
  return ready;
}

}  // namespace

ReadySession set_up_session(const ConnectionSettings& settings, int named_process,
                            const AskRow& ask) {
  const SessionSettings wanted = session_settings(settings);
  const std::vector<std::string> values = ask(set_statement(wanted, named_process));
  if (values.empty()) return set_up_pooled(settings, ask);
  return with_check(named_process, wanted, values, ask);
}

void cancel_statement(const ConnectionSettings& settings, int process) {
  if (process == 0) return;
  // Of several hosts this may be another one, where the number is somebody else's: the name is not.
  static_cast<void>(
      query_once(settings,
                 "SELECT pg_catalog.pg_cancel_backend(pid) FROM pg_catalog.pg_stat_activity"
                 " WHERE pid OPERATOR(pg_catalog.=) " +
                     std::to_string(process) +
                     " AND application_name OPERATOR(pg_catalog.=)"
                     " pg_catalog.current_setting('application_name')"));
}

}  // namespace loopscope::storage
