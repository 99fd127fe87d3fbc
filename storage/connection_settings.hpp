#pragma once

#include <string>

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
  bool keep_search_path = false;  ///< else pg_catalog alone, so that no schema can put its own
                                  ///< now() or operator into the place of PostgreSQL's
};

/// `settings.conninfo` completed with time-outs, keepalives, application_name
/// ("loopscope/<purpose>/<host>/<pid>") and the session options of every connection (UTC, no JIT,
/// custom plans, statement_timeout, lock_timeout). What the user's conninfo already sets is left
/// alone, with two exceptions: `options` is extended (what the user sets there wins), and
/// client_encoding is always UTF8. Session options of a pg_service.conf entry are replaced by ours,
/// because libpq merges no two of them. Throws DatabaseError (give_up) when libpq cannot parse it.
[[nodiscard]] std::string complete_conninfo(const ConnectionSettings& settings);

/// "results database (host=db1 dbname=plant user=monitor)" for messages, without any secret.
/// Throws like complete_conninfo.
[[nodiscard]] std::string describe_target(const ConnectionSettings& settings);

}  // namespace loopscope::storage
