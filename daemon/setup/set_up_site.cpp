#include "daemon/setup/set_up_site.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <optional>
#include <utility>

#include "config/first_settings.hpp"
#include "config/read_settings.hpp"
#include "core/text/counted.hpp"
#include "daemon/output/output_file.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/setup/check_databases.hpp"
#include "daemon/setup/choose_layout.hpp"
#include "daemon/setup/login_text.hpp"
#include "daemon/setup/next_commands.hpp"
#include "daemon/setup/recognise_layouts.hpp"
#include "daemon/setup/scripts.hpp"
#include "daemon/setup/site_logins.hpp"
#include "daemon/setup/vendor_layouts.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/printable.hpp"
#include "daemon/text/shell_word.hpp"
#include "daemon/text/time_text.hpp"
#include "storage/historian/setup/reader_sql.hpp"
#include "storage/results/schema/results_sql.hpp"

namespace loopscope::daemon {
namespace {

void refuse_existing(const SiteOptions& options) {
  std::error_code ignored;
  if (options.force || !std::filesystem::exists(options.out, ignored)) return;
  throw Failure(ExitCode::usage, options.out + " exists already",
                fmt::format("--force writes it anew, --out another one; `loopscope check-config "
                            "--config {}` checks it as it is",
                            options.out));
}

config::Settings ask_connections(SiteOptions& options, Questions& questions) {
  config::Settings settings;
  settings.results.connection = questions.text(
      options.results, "--results",
      "Results database, which Loopscope writes (libpq connection string or service=NAME)",
      "host=localhost dbname=loopscope");
  settings.results.owner_connection = options.owner;
  settings.historians.emplace_back();
  settings.historians.front().name = options.name;
  settings.historians.front().connection =
      questions.text(options.historian, "--historian",
                     "Historian, which it reads (libpq connection string or service=NAME)", "");
  complete_connections(settings);
  return settings;
}

[[nodiscard]] std::string hand_out_results(const SiteLogins& logins, const std::string& folder) {
  storage::ResultsWanted wanted{logins.worker.target.database, logins.database_is_there(), {}};
  if (!logins.owner.exists())
    wanted.logins.push_back({logins.owner.target.user, "loopscope_owner"});
  if (!logins.worker.exists())
    wanted.logins.push_back({logins.worker.target.user, "loopscope_worker"});
  if (wanted.logins.size() == 2) {
    for (const PeoplesLogin& login : kPeoplesLogins)
      wanted.logins.push_back({login.name, login.group});
  }
  return hand_out({"the results server", "results.sql", "postgres", storage::results_sql(wanted)},
                  logins.worker.target, folder);
}

[[nodiscard]] std::string hand_out_historian(const SiteLogins& logins,
                                             const storage::ReaderWanted& wanted,
                                             const std::string& folder) {
  return hand_out({"the historian", "historian.sql", logins.reader.target.database,
                   storage::reader_sql(wanted), wanted.login_exists},
                  logins.reader.target, folder);
}

/// Before anybody has looked: the table that was said with its schema, or those of the vendor.
std::vector<storage::TableName> told_tables(const LayoutWishes& wishes) {
  const std::string& table = wishes.table;
  if (table.empty()) return usual_tables(wishes.preset);
  const std::size_t dot = table.find('.');
  if (dot == std::string::npos) return {};
  return {{table.substr(0, dot), table.substr(dot + 1)}};
}

void print_passwords(const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  std::cout << "\nTheir passwords belong into ~/.pgpass (or the file that PGPASSFILE names), mode "
               "0600, a line each, in place of a line with a wrong one:\n";
  for (const std::string& line : lines) std::cout << printable(line) << '\n';
}

/// "run results.sql and historian.sql, see to the passwords": what of it there is.
std::string what_to_do(std::vector<std::string> scripts, bool passwords) {
  scripts.erase(std::unique(scripts.begin(), scripts.end()), scripts.end());
  std::string run;
  for (const std::string& script : scripts) run += (run.empty() ? "run " : " and ") + script;
  return fmt::format("{}{}{}", run, !run.empty() && passwords ? ", " : "",
                     passwords     ? "see to the passwords"
                     : run.empty() ? "see the hints above"
                                   : "");
}

/// In UTC, as the months of the results are.
std::string day_a_week_ago() {
  const auto ago = std::chrono::system_clock::now() - std::chrono::days(7);
  return day_in_zone(std::chrono::floor<std::chrono::microseconds>(ago).time_since_epoch().count(),
                     TimeZone());
}

class SiteSetup {
 public:
  SiteSetup(SiteOptions options, Questions& questions)
      : options_(std::move(options)), questions_(questions) {}

  void run() {
    refuse_existing(options_);
    settings_ = ask_connections(options_, questions_);
    logins_ = try_logins(settings_);
    for (const SiteLogin* login : {&logins_.worker, &logins_.owner, &logins_.reader})
      std::cout << login_text(*login);
    require_historian();
    if (logins_.results_need_sql())
      scripts_.push_back(hand_out_results(logins_, options_.sql_folder));
    const bool historian_ready = look_at_historian();
    if (!logins_.results_work() || !historian_ready) ask_for_another_run();
    write();
    check();
  }

 private:
  /// No SQL makes a historian.
  void require_historian() const {
    const SiteLogin& reader = logins_.reader;
    if (!reader.refused_by(storage::LoginTrial::Refusal::no_database)) return;
    throw Failure(ExitCode::database, reader.trial.problem,
                  fmt::format("is dbname={} in --historian spelt right? `psql -l` lists the "
                              "databases of a server",
                              reader.target.database));
  }

  /// False while its administrator has something to do; the SQL for that has been handed out.
  bool look_at_historian() {
    const std::string& user = logins_.reader.target.user;
    if (!logins_.reader.works()) {
      if (!logins_.reader.exists()) ask_historian({user, false, told_tables(options_.layout), ""});
      return false;
    }
    storage::HistorianSurvey survey(historian_connection(settings_.historians.front()));
    layout_ = choose_layout(survey.tables(), options_.layout, questions_);
    std::cout << fmt::format("ok       {}\n", printable(describe(*layout_)));
    if (!layout_->readable) {
      std::cout << fmt::format("not yet  {} has no right to read it\n", printable(user));
      ask_historian({user, true, layout_->tables, layout_->maker});
      return false;
    }
    notes_ = look_at_rows(survey, options_.time_zone, questions_, *layout_);
    return true;
  }

  void ask_historian(const storage::ReaderWanted& wanted) {
    scripts_.push_back(hand_out_historian(logins_, wanted, options_.sql_folder));
  }

  [[noreturn]] void ask_for_another_run() const {
    const std::vector<std::string> passwords = password_lines(logins_);
    print_passwords(passwords);
    throw Failure(ExitCode::database,
                  logins_.results_work()         ? "the historian is not ready yet"
                  : layout_ && layout_->readable ? "the results server is not ready yet"
                                                 : "the servers are not ready yet",
                  what_to_do(scripts_, !passwords.empty()) +
                      ", then run this `loopscope init` again: it goes on from there; no settings "
                      "were written yet");
  }

  void write() {
    config::HistorianSettings historian = layout_->historian;
    historian.name = options_.name;
    historian.connection = settings_.historians.front().connection;
    const std::string text = config::first_settings_text(
        {settings_.results.connection, settings_.results.owner_connection,
         storage::with_user(results_connection(settings_), kEngineerLogin), historian, notes_});
    settings_ = config::parse_settings(text, options_.out);
    refuse_existing(options_);
    write_file(options_.out, text);
    std::cout << fmt::format("wrote    {}\n", printable(options_.out));
    for (const std::string& note : notes_) std::cout << "look at  " << printable(note) << '\n';
  }

  void check() const {
    const DatabaseCheck found =
        check_databases(settings_, options_.out, storage::SchemaStage::to_be_made);
    if (found.problems > 0) {
      throw Failure(
          ExitCode::database,
          core::text::counted(found.problems, "problem", "problems") + " with the databases",
          fmt::format("each PROBLEM above has its own hint; afterwards: loopscope "
                      "check-config --config {}",
                      options_.out));
    }
    std::cout << '\n';
    for (const storage::Finding& index : found.indexes)
      std::cout << index_command(index, logins_.reader.target);
    std::cout << next_commands(printable(shell_word(options_.out)), day_a_week_ago());
  }

  SiteOptions options_;
  Questions& questions_;
  config::Settings settings_;
  SiteLogins logins_;
  std::optional<LayoutCandidate> layout_;
  std::vector<std::string> notes_;
  std::vector<std::string> scripts_;  ///< what was handed out, as hand_out() calls it
};

}  // namespace

void set_up_site(SiteOptions options, Questions& questions) {
  SiteSetup(std::move(options), questions).run();
}

}  // namespace loopscope::daemon
