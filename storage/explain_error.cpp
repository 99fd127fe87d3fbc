#include "storage/explain_error.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "storage/lost_session.hpp"
#include "storage/session_setup.hpp"

namespace loopscope::storage {
namespace {

using Hint = std::string (*)(const RawError&, const ErrorPlace&);

/// Starts with the code (a class of two characters or a whole SQLSTATE): first match counts.
struct StateRule {
  std::string_view code;
  Remedy remedy;
  Hint hint;
};

/// libpq gives no SQLSTATE when connecting fails: its words have to do.
struct WordsRule {
  std::string_view words;
  Remedy remedy;
  const char* hint;
};

bool is_results(const ErrorPlace& place) {
  return place.kind == DatabaseKind::results;
}

std::string user_or_placeholder(const ErrorPlace& place) {
  return place.user.empty() ? "USER" : place.user;
}

/// The words after `start` up to the end of the line.
std::string_view rest_of_line(std::string_view message, std::string_view start) {
  const std::size_t at = message.find(start);
  if (at == std::string_view::npos) return {};
  message.remove_prefix(at + start.size());
  return message.substr(0, message.find('\n'));
}

/// The rights that the statement needs on an object of this kind.
std::string needed_rights(std::string_view kind, std::string_view statement) {
  if (kind == "database") return "CREATE ON DATABASE ";
  if (kind == "schema")
    return statement == "create_table" ? "USAGE, CREATE ON SCHEMA " : "USAGE ON SCHEMA ";
  const bool writes = statement == "copy_rows" || statement == "delete_rows";
  return writes ? "SELECT, INSERT, DELETE ON " : "SELECT ON ";
}

std::string grant_on(std::string_view kind, std::string_view name, const ErrorPlace& place) {
  return "GRANT " + needed_rights(kind, place.statement) + std::string(name) + " TO " +
         user_or_placeholder(place);
}

std::string hint_privilege(const RawError& error, const ErrorPlace& place) {
  const std::string_view object = rest_of_line(error.message, "permission denied for ");
  const std::string_view kind = object.substr(0, object.find(' '));
  const std::string_view name = object.substr(std::min(object.size(), kind.size() + 1));
  if (is_results(place) && kind == "database")
    return "as a superuser: psql -d " + std::string(name) + " -f deploy/roles.sql, or " +
           grant_on(kind, name, place);
  if (is_results(place))
    return "run `loopscope migrate --config F` as the owner, which grants the rights of the group"
           " roles, and make the user a member: GRANT loopscope_worker TO " +
           user_or_placeholder(place) +
           " (loopscope_owner to change the catalogue or the schema, loopscope_engineer to "
           "annotate)";
  if (object.empty())
    return "let the table's owner grant the right to " + user_or_placeholder(place);
  return "as the owner: " + grant_on(kind, name, place) +
         "; `loopscope check-config` prints every grant that is missing, with its schema";
}

std::string hint_relation(const RawError&, const ErrorPlace& place) {
  return is_results(place) ? "run `loopscope migrate --config F` as the owner"
                           : "check `table` of this historian in the settings (schema.table)";
}

std::string hint_column(const RawError&, const ErrorPlace& place) {
  return is_results(place) ? "the schema is not the one of this program: run `loopscope migrate "
                             "--config F` as the owner"
                           : "check the column names of this historian in the settings";
}

std::string hint_type(const RawError&, const ErrorPlace& place) {
  return is_results(place) ? "the stored value does not fit: report this as a fault of the program"
                           : "check `time_kind`, `quality_rule` and the columns' types of this "
                             "historian; a view can convert what does not fit";
}

template <char const* text>
std::string fixed(const RawError&, const ErrorPlace&) {
  return text;
}

#define LOOPSCOPE_AGAIN "a worker tries again by itself, a command has to be run again"
constexpr char kGone[] = "the server ended the connection: " LOOPSCOPE_AGAIN;
constexpr char kBroken[] =
    "the connection broke while it was made: " LOOPSCOPE_AGAIN
    "; if that goes on, see the server's log, and whether something between ends or answers "
    "connections";
constexpr char kAgain[] = "other sessions were in the way: " LOOPSCOPE_AGAIN;
constexpr char kLock[] =
    "another session holds a lock: see pg_locks and pg_stat_activity; " LOOPSCOPE_AGAIN;
#undef LOOPSCOPE_AGAIN
constexpr char kSlow[] =
    "the server was too slow: look for a missing index with `loopscope check-config`";

/// The server stops a statement that waits for a lock by lock_timeout. Where the statement's own
/// time was over first, only its context tells: "while locking tuple (0,1) in relation ...".
std::string hint_time_out(const RawError& error, const ErrorPlace& place) {
  const bool waited_for_row = error.message.find("ing tuple (") != std::string::npos;
  return waited_for_row || place.statement.starts_with("lock_") ? kLock : kSlow;
}

constexpr char kDependent[] =
    "an object of the site's own depends on what changes (the detail names it): let its owner drop "
    "it, repeat this, and create it again";
constexpr char kOwnSetting[] =
    "the server refuses a setting: see options= in the connection string, and leave out what it "
    "names";
constexpr char kStartupParameter[] =
    "PgBouncer refuses it at the start of a connection: leave it out of the connection string "
    "and of the environment (PGGEQO); settings as -c NAME=VALUE in options= are sent later";
constexpr char kReadOnly[] =
    "the server is a standby or read-only: name the primary, or all hosts, in the connection "
    "string";
constexpr char kDisk[] = "free space on the database server's disk";
constexpr char kMemory[] = "the server is out of memory: lower schedule.batch_loops";
constexpr char kConnections[] =
    "raise max_connections on the server or lower daemon.workers in the settings";
constexpr char kPassword[] = "check the user in the connection string and ~/.pgpass (mode 0600)";
constexpr char kNoPassword[] =
    "put HOST:PORT:DATABASE:USER:PASSWORD into ~/.pgpass (or the file that passfile= or PGPASSFILE "
    "names) and chmod 0600 it: one that others may read is ignored";
constexpr char kOtherName[] =
    "connect by a name that stands in the server's certificate (host=NAME, hostaddr= for the "
    "address beside it), or have a certificate made for this one";
constexpr char kNotVerified[] =
    "the certificate in sslrootcert is not of the authority that signed the server's, or one of "
    "the two has expired: `openssl s_client -starttls postgres -connect HOST:PORT -CAfile "
    "SSLROOTCERT` says which";
constexpr char kPlainServer[] =
    "let the server's administrator set ssl = on: with less than sslmode=verify-full anybody on "
    "the way could read along";
constexpr char kRootCertificate[] =
    "name the certificate of the authority that signed the server's: sslrootcert=FILE";
constexpr char kPrivateKey[] = "chmod 0600 the file of sslkey=, and let this user own it";
constexpr char kDatabase[] = "check dbname in the connection string, or create the database";
constexpr char kConstraint[] = "the value breaks a rule of the schema: see the detail above";
constexpr char kQueueOfMessages[] =
    "a limit of the server was reached; of too many notifications: a listening session has an open "
    "transaction, the server's log names its process";
constexpr char kOtherServer[] =
    "the server behind a foreign table does not answer, or not as PostgreSQL asks: try it from the "
    "machine of PostgreSQL, and look at CREATE SERVER, CREATE USER MAPPING and the columns of the "
    "foreign table";
constexpr char kServerFault[] = "a fault of the server: read its log";

constexpr std::array<StateRule, 28> kStates{{
    {"08", Remedy::reconnect, fixed<kGone>},
    {"57P04", Remedy::give_up, fixed<kDatabase>},
    {"57P", Remedy::reconnect, fixed<kGone>},
    {"57014", Remedy::retry, hint_time_out},
    {"25P03", Remedy::reconnect, fixed<kGone>},
    {"25006", Remedy::reconnect, fixed<kReadOnly>},
    {"40", Remedy::retry, fixed<kAgain>},
    {"55P03", Remedy::retry, fixed<kLock>},
    {"53100", Remedy::give_up, fixed<kDisk>},
    {"53200", Remedy::retry, fixed<kMemory>},
    {"53300", Remedy::reconnect, fixed<kConnections>},
    {"54000", Remedy::give_up, fixed<kQueueOfMessages>},
    {"42501", Remedy::give_up, hint_privilege},
    {"42P01", Remedy::give_up, hint_relation},
    {"3F000", Remedy::give_up, hint_relation},
    {"42703", Remedy::give_up, hint_column},
    {"42804", Remedy::give_up, hint_type},
    {"42846", Remedy::give_up, hint_type},
    {"42883", Remedy::give_up, hint_type},
    {"22", Remedy::give_up, hint_type},
    {"23", Remedy::give_up, fixed<kConstraint>},
    {"28", Remedy::give_up, fixed<kPassword>},
    {"2BP01", Remedy::give_up, fixed<kDependent>},
    {"3D000", Remedy::give_up, fixed<kDatabase>},
    {"HV", Remedy::give_up, fixed<kOtherServer>},
    {"XX", Remedy::give_up, fixed<kServerFault>},
    {"58", Remedy::give_up, fixed<kServerFault>},
    {"", Remedy::give_up, fixed<kServerFault>},
}};

// What a server that ends or a network that breaks leaves behind in a TLS handshake comes before
// the other words of TLS, which stand for settings and certificates.
constexpr std::array<WordsRule, 26> kConnecting{{
    {"does not match host name", Remedy::give_up, kOtherName},
    {"certificate verify failed", Remedy::give_up, kNotVerified},
    {"server does not support SSL", Remedy::give_up, kPlainServer},
    {"root certificate file", Remedy::give_up, kRootCertificate},
    {"private key file", Remedy::give_up, kPrivateKey},
    {"unsupported startup parameter", Remedy::give_up, kStartupParameter},
    {"no password supplied", Remedy::give_up, kNoPassword},
    {"role \"", Remedy::give_up,
     "check user= in the connection string, or create the login: CREATE ROLE name LOGIN IN ROLE "
     "loopscope_worker (deploy/roles.sql makes the group roles)"},
    {"password", Remedy::give_up, kPassword},
    {"Peer authentication failed", Remedy::give_up,
     "run as the system user of that name, or set up another method in pg_hba.conf"},
    {"pg_hba.conf", Remedy::give_up, "let the database's administrator add a line to pg_hba.conf"},
    {"SSL SYSCALL error", Remedy::reconnect, kBroken},
    {"unexpected eof while reading", Remedy::reconnect, kBroken},
    {"SSL negotiation packet", Remedy::reconnect, kBroken},
    {"SSL connection has been closed", Remedy::reconnect, kBroken},
    {"server closed the connection unexpectedly", Remedy::reconnect, kBroken},
    {"Connection reset by peer", Remedy::reconnect, kBroken},
    {"SSL", Remedy::give_up, "check sslmode and sslrootcert in the connection string"},
    {"certificate", Remedy::give_up, "check sslrootcert in the connection string"},
    {"definition of service", Remedy::give_up, "check service= and pg_service.conf"},
    {"permission denied for database", Remedy::give_up, "GRANT CONNECT ON DATABASE to the user"},
    {"session is read-only", Remedy::reconnect, kReadOnly},
    {"connection slots", Remedy::reconnect, kConnections},
    {"too many clients", Remedy::reconnect, kConnections},
    {"could not translate host name", Remedy::reconnect,
     "check host= in the connection string, and the name server"},
    {"the database system is", Remedy::reconnect, "wait until the server has started"},
}};
constexpr const char* kUnreachable =
    "check that the server runs and that host= and port= in the connection string are right";

/// The line that has these words in it, else the first one.
std::string_view line_with(std::string_view words, std::string_view message) {
  const std::size_t at = message.find(words);
  if (at != std::string_view::npos && at > 0) {
    const std::size_t before = message.rfind('\n', at);
    if (before != std::string_view::npos) message.remove_prefix(before + 1);
  }
  return message.substr(0, message.find('\n'));
}

/// "ERROR:  what" without the severity, with the server's detail in brackets. Several hosts have a
/// line each: `words` choose one.
std::string primary_message(const RawError& error, std::string_view words = {}) {
  std::string_view line = line_with(words, error.message);
  for (const std::string_view severity : {"ERROR:  ", "FATAL:  ", "PANIC:  "}) {
    if (line.starts_with(severity)) line.remove_prefix(severity.size());
  }
  std::string message(line.empty() ? "the connection was lost" : line);
  const std::string_view detail = rest_of_line(error.message, "\nDETAIL:  ");
  if (!detail.empty()) message += " (" + std::string(detail) + ")";
  return message;
}

std::string place_text(const ErrorPlace& place) {
  return place.statement.empty() ? place.target
                                 : "statement " + place.statement + ", " + place.target;
}

/// No such setting, not this value, no right to it, not after the start.
bool refuses_setting(const RawError& error, const ErrorPlace& place) {
  return place.statement == kSettingStatement &&
         (error.sqlstate.starts_with("22") || error.sqlstate.starts_with("42") ||
          error.sqlstate == "55P02");
}

DatabaseError explain_connecting(const RawError& error, const ErrorPlace& place) {
  const auto what_of = [&](std::string_view words) {
    return primary_message(error, words) + ", " + place_text(place);
  };
  // Several hosts give several lines: the words may stand in any of them.
  for (const WordsRule& rule : kConnecting) {
    if (error.message.find(rule.words) != std::string::npos)
      return {what_of(rule.words), rule.hint, rule.remedy};
  }
  const std::string what = what_of({});
  const bool no_database = error.message.find("database \"") != std::string::npos &&
                           error.message.find("does not exist") != std::string::npos;
  if (no_database) return {what, kDatabase, Remedy::give_up};
  return {what, kUnreachable, Remedy::reconnect};
}

}  // namespace

DatabaseError explain(const RawError& error, const ErrorPlace& place) {
  if (error.sqlstate.empty() && place.statement.empty()) return explain_connecting(error, place);
  if (const auto setting = lost_setting(error.message))
    return explain_lost_session(*setting, place.target);
  const std::string what = primary_message(error) + ", " + place_text(place);
  if (error.sqlstate.empty() || error.connection_lost)
    return {what, kGone, Remedy::reconnect, error.sqlstate};
  if (refuses_setting(error, place)) return {what, kOwnSetting, Remedy::give_up, error.sqlstate};
  for (const StateRule& rule : kStates) {
    if (error.sqlstate.starts_with(rule.code))
      return {what, rule.hint(error, place), rule.remedy, error.sqlstate};
  }
  return {what, kServerFault, Remedy::give_up, error.sqlstate};
}

}  // namespace loopscope::storage
