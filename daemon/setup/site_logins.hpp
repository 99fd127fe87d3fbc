#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.hpp"
#include "storage/check_connection.hpp"
#include "storage/connection_target.hpp"
#include "storage/historian/setup/try_login.hpp"
#include "storage/near_password.hpp"

namespace loopscope::daemon {

/// A login that people get with a new database, beside those that the settings name.
struct PeoplesLogin {
  const char* name;
  const char* group;  ///< role of deploy/roles.sql
};
inline constexpr const char* kEngineerLogin = "loopscope_engineer_1";
inline constexpr std::array kPeoplesLogins{PeoplesLogin{"loopscope_reader_1", "loopscope_reader"},
                                           PeoplesLogin{kEngineerLogin, "loopscope_engineer"}};

/// A login that the settings name, where it goes, and whether it works.
struct SiteLogin {
  std::string role;    ///< worker, owner, historian's reader
  std::string option;  ///< that names it
  storage::ConnectionTarget target;
  storage::LoginTrial trial;
  bool seen = false;  ///< another login has seen that the server has it
  /// Where no password is known: that of the password file which comes nearest.
  std::optional<storage::NearPassword> near = {};
  /// Where no password is known: what is wrong with the file that may hold it.
  std::vector<storage::Finding> password_sources = {};

  [[nodiscard]] bool refused_by(storage::LoginTrial::Refusal refusal) const {
    return !works() && trial.refusal == refusal;
  }
  /// A password is kept for it which libpq did not take: dbname is mistyped or new, or the file is
  /// ignored.
  [[nodiscard]] bool has_kept_password() const {
    return near && (near->part.empty() || near->part == "dbname");
  }
  /// As far as is known nobody has to make it.
  [[nodiscard]] bool exists() const {
    using enum storage::LoginTrial::Refusal;
    return works() || seen || has_kept_password() || refused_by(no_database) ||
           refused_by(no_right);
  }
  [[nodiscard]] bool works() const { return trial.state == storage::LoginTrial::State::works; }
};

struct SiteLogins {
  SiteLogin worker, owner, reader;

  /// The login of the owner may be missing where the worker's works, or the other way round.
  [[nodiscard]] bool results_work() const { return worker.works() && owner.works(); }
  [[nodiscard]] bool database_is_there() const {
    return worker.works() || owner.works() || (reader.works() && is_same_database());
  }
  /// The results lie beside the historian's tables.
  [[nodiscard]] bool is_same_database() const {
    const storage::ConnectionTarget &results = worker.target, &historian = reader.target;
    return results.host == historian.host && results.port == historian.port &&
           results.database == historian.database;
  }
  /// Whether SQL is missing, and not only the right password or the right name.
  [[nodiscard]] bool results_need_sql() const {
    if (worker.has_kept_password() && owner.has_kept_password()) return false;
    return !database_is_there() || !worker.exists() || !owner.exists();
  }
};

/// The connection strings as the settings will have them: a login is added where none is said, and
/// the owner's is the worker's with another login unless it is said. Throws Failure (usage) for a
/// password, DatabaseError for what libpq cannot read.
void complete_connections(config::Settings& settings);

/// Tries the three logins of settings with one historian. Throws DatabaseError where a server does
/// not answer: no SQL would help.
[[nodiscard]] SiteLogins try_logins(const config::Settings& settings);

/// A line each for the password file, of those whose passwords are missing or refused; of people's
/// logins too where the database is to be made.
[[nodiscard]] std::vector<std::string> password_lines(const SiteLogins& logins);

}  // namespace loopscope::daemon
