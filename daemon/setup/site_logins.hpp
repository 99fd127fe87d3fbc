#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/settings.hpp"
#include "storage/connection_target.hpp"
#include "storage/historian/setup/try_login.hpp"

namespace loopscope::daemon {

/// A login that people get with a new database, beside those that the settings name.
struct PeoplesLogin {
  const char* name;
  const char* group;  ///< role of deploy/roles.sql
};
inline constexpr std::array kPeoplesLogins{
    PeoplesLogin{"loopscope_reader_1", "loopscope_reader"},
    PeoplesLogin{"loopscope_engineer_1", "loopscope_engineer"}};

/// A login that the settings name, where it goes, and whether it works.
struct SiteLogin {
  std::string role;  ///< worker, owner, historian's reader
  storage::ConnectionTarget target;
  storage::LoginTrial trial;

  [[nodiscard]] bool works() const { return trial.state == storage::LoginTrial::State::works; }
};

struct SiteLogins {
  SiteLogin worker, owner, reader;

  /// The login of the owner may be missing where the worker's works, or the other way round.
  [[nodiscard]] bool results_work() const { return worker.works() && owner.works(); }
  [[nodiscard]] bool database_is_there() const { return worker.works() || owner.works(); }
};

/// The connection strings as the settings will have them: a login is added where none is said, and
/// the owner's is the worker's with another login unless it is said. Throws Failure (usage) for a
/// password, DatabaseError for what libpq cannot read.
void complete_connections(config::Settings& settings);

/// Tries the three logins of settings with one historian. Throws DatabaseError where a server does
/// not answer: no SQL would help.
[[nodiscard]] SiteLogins try_logins(const config::Settings& settings);

/// A line each for the password file, of those that do not work yet; of people's logins too where
/// the database is to be made.
[[nodiscard]] std::vector<std::string> password_lines(const SiteLogins& logins);

}  // namespace loopscope::daemon
