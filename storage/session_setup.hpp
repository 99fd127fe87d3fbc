#pragma once

#include <functional>
#include <string>
#include <vector>

#include "storage/connection_settings.hpp"
#include "storage/statement.hpp"

namespace loopscope::storage {

/// The name of the statement that sends the settings, the user's own among them.
inline constexpr const char* kSettingStatement = "session_settings";

/// Runs one statement on a connection, in a transaction of its own, and returns the columns of its
/// row; nothing when there is none. Throws DatabaseError.
using AskRow = std::function<std::vector<std::string>(const Statement& statement)>;

/// The session that a connection has once it is set up.
struct ReadySession {
  int process = 0;  ///< the server's process
  /// Fails, so that nothing which is sent after it is done, where the session is another one or its
  /// settings are no longer the program's.
  std::string check_sql;
};

/// Sets up a fresh connection's session (session_settings).
///
/// Settings do not travel with the connection's start, where poolers refuse or drop them. A direct
/// connection takes them in one statement and the check in another: its process is the one that the
/// server named at the start
/// (`named_process`). Where it is another one a pooler stands between, and it is first asked,
/// before anything of a session is changed that may be somebody else's, whether it keeps one
/// session for one client; then the settings are sent, and read back in a transaction of their own.
///
/// What holds afterwards is not left to that: whoever speaks over the connection sends `check_sql`
/// in the same transaction before each statement, or at the start of a transaction of several. A
/// pooler that lends a session by transaction lends it for no less than that.
///
/// Throws DatabaseError (give_up) where a pooler does not keep the session, and what `ask` throws.
[[nodiscard]] ReadySession set_up_session(const ConnectionSettings& settings, int named_process,
                                          const AskRow& ask);

/// Asks the server, over a connection of its own, to end what the connection's session runs: a
/// statement that nobody waits for any more. Takes a few seconds at most; a server that stands
/// still is left to itself. Process 0 is none. Throws like complete_conninfo.
void cancel_statement(const ConnectionSettings& settings, int process);

}  // namespace loopscope::storage
