#include "daemon/setup/login_text.hpp"

#include <fmt/format.h>

#include "daemon/text/printable.hpp"
#include "storage/quoted_identifier.hpp"

namespace loopscope::daemon {
namespace {

using Refusal = storage::LoginTrial::Refusal;

struct Trouble {
  std::string what, hint;
};

std::string password_file(const SiteLogin& login) {
  const std::string& file = login.target.password_file;
  return file.empty() ? "the password file" : file;
}

/// libpq looks for a password by host, port, database and login: a mistyped one has none.
Trouble no_password(const SiteLogin& login) {
  const char* what = login.seen ? "the login is there, but its password is not known here"
                                : "no password for it is known here";
  if (!login.password_sources.empty()) {
    const storage::Finding& source = login.password_sources.front();
    return {what, source.what + ": " + source.hint};
  }
  if (!login.near) return {what, ""};
  if (login.near->part.empty()) return {what, password_file(login) + " has a line for it: see it"};
  return {what,
          fmt::format("{0} has one for {1}={2}: is {1} in {3} spelt right? If so, add the "
                      "line below",
                      password_file(login), login.near->part, login.near->other, login.option)};
}

Trouble wrong_password(const SiteLogin& login) {
  const std::string correct = fmt::format(
      "correct its line in {}, of which the first that fits counts", password_file(login));
  if (login.exists()) {
    return {"the password is wrong, the login is there",
            fmt::format("{}; a superuser sets a new one in psql: \\password {}", correct,
                        login.target.user)};
  }
  return {
      "the password is wrong, or there is no such login: the server does not tell which",
      fmt::format("if the login is there, {}; the SQL that this hands out is for a login that is "
                  "not there yet, and sets a new password",
                  correct)};
}

Trouble trouble_of(const SiteLogin& login) {
  switch (login.trial.refusal) {
    case Refusal::no_password:
      return no_password(login);
    case Refusal::password_or_login:
      return wrong_password(login);
    case Refusal::no_login:
      return {"there is no such login", ""};
    case Refusal::no_database:
      return {"the login works, but the server has no such database",
              fmt::format("is dbname={} in {} spelt right?", login.target.database, login.option)};
    case Refusal::no_right:
      return {"the login is there, but may not connect to the database",
              fmt::format("as its owner: GRANT CONNECT ON DATABASE {} TO {}",
                          storage::quoted_identifier(login.target.database),
                          storage::quoted_identifier(login.target.user))};
    case Refusal::other:
      break;
  }
  return {login.trial.problem, login.trial.hint};
}

}  // namespace

std::string login_text(const SiteLogin& login) {
  const storage::ConnectionTarget& to = login.target;
  const std::string whom = fmt::format("{}: {}, database {} at {}:{}", login.role, to.user,
                                       to.database, to.host, to.port);
  if (login.works()) return fmt::format("ok       {}\n", printable(whom));
  const Trouble trouble = trouble_of(login);
  const std::string text =
      fmt::format("not yet  {}: {}\n", printable(whom), printable(trouble.what));
  return trouble.hint.empty() ? text
                              : text + fmt::format("         HINT: {}\n", printable(trouble.hint));
}

}  // namespace loopscope::daemon
