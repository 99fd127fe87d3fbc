#include "daemon/setup/site_logins.hpp"

#include <fmt/format.h>

#include "config/connection_secret.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/text/failure.hpp"
#include "storage/error.hpp"

namespace loopscope::daemon {
namespace {

using storage::LoginTrial;

constexpr const char* kWorker = "loopscope_worker_1";
constexpr const char* kOwner = "loopscope_owner_1";
constexpr const char* kReader = "loopscope_historian_1";

/// Command lines are seen by everybody on the host, and kept by shells.
void refuse_secret(const std::string& connection, const std::string& option) {
  if (!config::holds_secret(connection) && !config::has_text_for_port(connection)) return;
  throw Failure(ExitCode::usage, option + " holds a password, or a text where a port should be",
                "leave it out and put HOST:PORT:DATABASE:USER:PASSWORD into ~/.pgpass (mode 0600)");
}

void add_user(std::string& connection, const storage::ConnectionSettings& settings,
              const std::string& user) {
  if (!storage::says_user(settings)) connection = storage::with_user(settings, user);
}

SiteLogin try_one(const std::string& role, const std::string& option,
                  const storage::ConnectionSettings& settings) {
  SiteLogin login{role, option, storage::connection_target(settings), storage::try_login(settings)};
  if (login.trial.state == LoginTrial::State::unreachable) {
    throw storage::DatabaseError(login.trial.problem, login.trial.hint + " (" + option + ")",
                                 storage::Remedy::reconnect);
  }
  if (login.refused_by(LoginTrial::Refusal::no_password)) {
    login.near = storage::find_near_password(login.target);
    login.password_sources = storage::check_password_sources(settings);
  }
  return login;
}

/// Asks by the login of the same server that works whether the other one is there.
void look_for(SiteLogin& login, const SiteLogin& other, const storage::ConnectionSettings& by) {
  if (login.works() || !other.works()) return;
  login.seen = storage::login_exists(by, login.target.user);
}

/// As libpq wants a field of its password file.
std::string field(const std::string& text) {
  std::string escaped;
  for (const char character : text) {
    if (character == ':' || character == '\\') escaped += '\\';
    escaped += character;
  }
  return escaped;
}

std::string first_of(const std::string& list) {
  return list.substr(0, list.find(','));
}

}  // namespace

void complete_connections(config::Settings& settings) {
  config::ResultsSettings& results = settings.results;
  std::string& historian = settings.historians.front().connection;
  refuse_secret(results.connection, "--results");
  refuse_secret(results.owner_connection, "--owner");
  refuse_secret(historian, "--historian");
  if (results.owner_connection.empty())
    results.owner_connection = storage::with_user(results_connection(settings), kOwner);
  add_user(results.connection, results_connection(settings), kWorker);
  add_user(results.owner_connection, owner_connection(settings), kOwner);
  add_user(historian, historian_connection(settings.historians.front()), kReader);
}

SiteLogins try_logins(const config::Settings& settings) {
  const config::HistorianSettings& historian = settings.historians.front();
  SiteLogins logins{try_one("worker", "--results", results_connection(settings)),
                    try_one("owner", "--owner, or --results", owner_connection(settings)),
                    try_one("historian's reader", "--historian", historian_connection(historian))};
  look_for(logins.worker, logins.owner, owner_connection(settings));
  look_for(logins.owner, logins.worker, results_connection(settings));
  return logins;
}

std::vector<std::string> password_lines(const SiteLogins& logins) {
  std::vector<std::string> lines;
  const auto lacks_password = [](const SiteLogin& login) {
    using enum LoginTrial::Refusal;
    const bool has_line = login.near && login.near->part.empty();
    return !login.works() && !has_line && !login.refused_by(no_database) &&
           !login.refused_by(no_right);
  };
  const auto add = [&](const storage::ConnectionTarget& to, const std::string& user) {
    lines.push_back(fmt::format("{}:{}:{}:{}:PASSWORD",
                                to.host.empty() ? "localhost" : field(first_of(to.host)),
                                field(first_of(to.port)), field(to.database), field(user)));
  };
  for (const SiteLogin* login : {&logins.worker, &logins.owner, &logins.reader})
    if (lacks_password(*login)) add(login->target, login->target.user);
  if (logins.worker.exists() || logins.owner.exists()) return lines;
  for (const PeoplesLogin& login : kPeoplesLogins) add(logins.worker.target, login.name);
  return lines;
}

}  // namespace loopscope::daemon
