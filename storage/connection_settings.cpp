#include "storage/connection_settings.hpp"

#include <algorithm>
#include <array>
#include <libpq-fe.h>
#include <memory>
#include <string_view>
#include <unistd.h>

#include "storage/error.hpp"
#include "storage/misplaced_options.hpp"

namespace loopscope::storage {
namespace {

using Options = ConnectionOptions;

/// A peer that is gone is given up after network_timeout_s while we send, and after a quarter more
/// while we wait. The kernel's defaults are hours.
struct Keepalive {
  explicit Keepalive(int network_timeout_s)
      : idle_s(std::max(1, network_timeout_s / 2)),
        interval_s(std::max(1, network_timeout_s / 4)) {}
  int idle_s;
  int interval_s;
  static constexpr int kCount = 3;
};

// Memory for the bitmap and the arrays of one batch (heap_order.hpp): with the usual 4 MB the
// bitmap forgets rows and whole pages are looked through, 17 ms a loop instead of 12.
constexpr const char* kReadingMemory = "32MB";

// Statements name the schemas of their tables; what they leave open are functions and operators.
constexpr const char* kSearchPath = "pg_catalog, pg_temp";

// Locks are waited for briefly, because whoever waits holds a lease that runs out.
constexpr int kLongestLockWait_ms = 5'000;

constexpr const char* kNotShown = " (not shown, it may hold a password)";

bool may_hold_secret(const std::string& conninfo) {
  return conninfo.find("password") != std::string::npos || conninfo.find('@') != std::string::npos;
}

/// libpq ends its words with a line break.
std::string first_line(std::string_view text) {
  return std::string(text.substr(0, text.find('\n')));
}

Options parse(const ConnectionSettings& settings) {
  char* raw_error = nullptr;
  const std::unique_ptr<PQconninfoOption, decltype(&PQconninfoFree)> parsed{
      PQconninfoParse(settings.conninfo.c_str(), &raw_error), &PQconninfoFree};
  const std::unique_ptr<char, decltype(&PQfreemem)> error{raw_error, &PQfreemem};
  if (!parsed) {
    const std::string why = error && !may_hold_secret(settings.conninfo)
                                ? ": " + first_line(error.get())
                                : std::string(kNotShown);
    throw DatabaseError("the connection string cannot be read" + why + ", " + settings.purpose,
                        "write it like \"host=db1 dbname=plant user=plant_monitor\"",
                        Remedy::give_up);
  }
  Options options;
  for (const PQconninfoOption* option = parsed.get(); option->keyword != nullptr; ++option) {
    if (option->val != nullptr) options[option->keyword] = option->val;
  }
  refuse_misplaced(options, settings.purpose);
  return options;
}

/// As the server would show it: beyond printable ASCII it puts question marks.
std::string ascii_name(std::string text, std::size_t most_bytes) {
  text.resize(std::min(text.size(), most_bytes));
  std::ranges::replace_if(
      text, [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

std::string application_name(const std::string& purpose) {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) host[0] = '\0';
  // The server cuts the whole at 63 bytes: shorten the names, so that the pid survives.
  return "loopscope/" + ascii_name(purpose, 20) + "/" + ascii_name(host.data(), 23) + "/" +
         std::to_string(getpid());
}

void add_network_options(const ConnectionSettings& settings, Options& options) {
  const Keepalive keepalive(settings.network_timeout_s);
  options.try_emplace("keepalives", "1");
  options.try_emplace("keepalives_idle", std::to_string(keepalive.idle_s));
  options.try_emplace("keepalives_interval", std::to_string(keepalive.interval_s));
  options.try_emplace("keepalives_count", std::to_string(Keepalive::kCount));
  options.try_emplace("tcp_user_timeout", std::to_string(1000 * settings.network_timeout_s));
}

/// The server has to notice our end as well: what it holds for a session whose client is gone (row
/// locks above all) is held against everybody else.
void add_server_side_network(const ConnectionSettings& settings, SessionSettings& session) {
  const Keepalive keepalive(settings.network_timeout_s);
  session["tcp_keepalives_idle"] = std::to_string(keepalive.idle_s);
  session["tcp_keepalives_interval"] = std::to_string(keepalive.interval_s);
  session["tcp_keepalives_count"] = std::to_string(Keepalive::kCount);
  session["tcp_user_timeout"] = std::to_string(1000 * settings.network_timeout_s);
}

/// Half of a statement's time at most: then it is the server that says that a lock was in the way,
/// and not a statement that seems to be slow.
std::string lock_timeout(const ConnectionSettings& settings) {
  const int half_ms = 500 * settings.statement_timeout_s;
  return std::to_string(half_ms > 0 ? std::min(half_ms, kLongestLockWait_ms) : kLongestLockWait_ms);
}

std::string join(const Options& options) {
  std::string conninfo;
  for (const auto& [key, value] : options) {
    if (!conninfo.empty()) conninfo += ' ';
    conninfo += key + "='";
    for (const char character : value) {
      if (character == '\'' || character == '\\') conninfo += '\\';
      conninfo += character;
    }
    conninfo += '\'';
  }
  return conninfo;
}

}  // namespace

std::string complete_conninfo(const ConnectionSettings& settings) {
  Options options = parse(settings);
  add_network_options(settings, options);
  options.try_emplace("connect_timeout", std::to_string(settings.connect_timeout_s));
  options.try_emplace("application_name", application_name(settings.purpose));
  // The one thing that the user cannot choose: all text in the program is UTF-8.
  options["client_encoding"] = "UTF8";
  // After a failover the former primary may still answer: writing there cannot work.
  if (!settings.read_only) options.try_emplace("target_session_attrs", "read-write");
  // What a pooler refuses or drops here is set once the connection stands (session_setup.hpp).
  // Empty, so that libpq takes none from a service file or PGOPTIONS.
  options["options"] = split_startup_options(options["options"]).rest;
  return join(options);
}

SessionSettings user_settings(const ConnectionSettings& settings) {
  return split_startup_options(parse(settings)["options"]).settings;
}

SessionSettings session_settings(const ConnectionSettings& settings) {
  SessionSettings session = user_settings(settings);
  SessionSettings ours{
      // The time zone and the float digits make results independent of the server's configuration.
      {"timezone", "UTC"},
      {"datestyle", "ISO"},
      {"extra_float_digits", "1"},
      {"client_min_messages", "warning"},
      {"jit", "off"},
      // A generic plan takes LIMIT $n for a tenth of the table and scans it all.
      {"plan_cache_mode", "force_custom_plan"},
      {"lock_timeout", lock_timeout(settings)},
      {"statement_timeout", std::to_string(settings.statement_timeout_s) + "s"},
      {"idle_in_transaction_session_timeout", std::to_string(settings.idle_timeout_s) + "s"},
      {"search_path", kSearchPath}};
  add_server_side_network(settings, ours);
  if (settings.read_only) {
    ours["default_transaction_read_only"] = "on";
    ours["work_mem"] = kReadingMemory;
  }
  session.merge(ours);  // what the user sets there wins
  session["client_encoding"] = "UTF8";
  return session;
}

std::string describe_target(const ConnectionSettings& settings) {
  const Options options = parse(settings);
  std::string described;
  for (const char* key : {"service", "host", "hostaddr", "port", "dbname", "user"}) {
    if (const auto found = options.find(key); found != options.end()) {
      described += (described.empty() ? "" : " ") + found->first + "=" + found->second;
    }
  }
  return settings.purpose + " database" + (described.empty() ? "" : " (" + described + ")");
}

}  // namespace loopscope::storage
