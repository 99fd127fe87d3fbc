#pragma once

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>

#include "storage/startup_options.hpp"

namespace loopscope::storage {

/// How to reach one database. Secrets stay in ~/.pgpass or pg_service.conf.
struct ConnectionSettings {
  std::string conninfo;          ///< libpq keyword/value string or URI
  std::string purpose;           ///< shown in application_name and messages: "results", ...
  int connect_timeout_s = 5;     ///< seconds
  int statement_timeout_s = 60;  ///< seconds; 0 = none
  int network_timeout_s = 20;    ///< seconds after which an unreachable peer is given up, >= 2
  int idle_timeout_s = 60;  ///< seconds that the server keeps an idle transaction, 0 = for ever
  bool read_only = false;   ///< historian readers never write
};

/// `settings.conninfo` completed with time-outs, keepalives and application_name
/// ("loopscope/<purpose>/<host>/<pid>"). What the user's conninfo already sets is left alone, with
/// two exceptions: client_encoding is always UTF8, and of `options` only what sets nothing stays:
/// no pooler takes it, so that settings are sent once the connection stands. Throws DatabaseError
/// (give_up) when libpq cannot parse it.
[[nodiscard]] std::string complete_conninfo(const ConnectionSettings& settings);

/// What the user sets for a session: `-c NAME=VALUE` of `options` in the connection string. Throws
/// like complete_conninfo.
[[nodiscard]] SessionSettings user_settings(const ConnectionSettings& settings);

/// What every session of such a connection is set to (UTC, no JIT, custom plans, statement_timeout,
/// lock_timeout, a search path of pg_catalog alone, ...); what the user sets by `options` in the
/// connection string wins. `options` of a service file and PGOPTIONS do not count. Throws like
/// complete_conninfo.
[[nodiscard]] SessionSettings session_settings(const ConnectionSettings& settings);

/// "results database (host=db1 dbname=plant user=monitor)" for messages, without any secret.
/// Throws like complete_conninfo.
[[nodiscard]] std::string describe_target(const ConnectionSettings& settings);

/// How long the client waits for a statement before it gives the connection up; nullopt = for ever.
///
/// The server's own statement_timeout comes first when all is well. A server that stands still
/// without dying (stopped, out of memory, its disk stuck) keeps its connections alive, so that
/// neither that nor any keepalive would ever end the wait.
[[nodiscard]] inline std::optional<std::chrono::seconds> patience(
    const ConnectionSettings& settings) {
  constexpr int kLongestGrace_s = 5;
  if (settings.statement_timeout_s <= 0) return std::nullopt;
  const int grace_s = std::clamp(settings.statement_timeout_s / 3, 1, kLongestGrace_s);
  return std::chrono::seconds(settings.statement_timeout_s + grace_s);
}

}  // namespace loopscope::storage
