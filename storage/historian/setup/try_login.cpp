#include "storage/historian/setup/try_login.hpp"

#include <string_view>

#include "storage/error.hpp"
#include "storage/historian/pq_connection.hpp"

namespace loopscope::storage {
namespace {

const Statement kLoginExists{"login_exists",
                             "SELECT FROM pg_catalog.pg_roles WHERE rolname = $1 AND rolcanlogin"};

/// libpq gives no SQLSTATE when connecting fails: its words have to do.
LoginTrial::Refusal refusal_of(std::string_view words) {
  using enum LoginTrial::Refusal;
  const auto says = [words](std::string_view text) { return words.find(text) != words.npos; };
  if (says("no password supplied")) return no_password;
  if (says("password authentication failed")) return password_or_login;
  if (says("permission denied for database")) return no_right;
  if (!says("does not exist")) return other;
  return says("database \"") ? no_database : says("role \"") ? no_login : other;
}

}  // namespace

LoginTrial try_login(const ConnectionSettings& settings) {
  static_cast<void>(complete_conninfo(settings));
  try {
    const PqConnection connection(settings);
    return {};
  } catch (const DatabaseError& error) {
    const bool answered = error.remedy() == Remedy::give_up;
    return {answered ? LoginTrial::State::refused : LoginTrial::State::unreachable, error.what(),
            error.hint(), refusal_of(error.what())};
  }
}

bool login_exists(const ConnectionSettings& settings, const std::string& user) {
  PqConnection connection(settings);
  return connection.run(kLoginExists, {user}).size() > 0;
}

}  // namespace loopscope::storage
