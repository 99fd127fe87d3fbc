#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/run_program.hpp"
#include "tests/support/source_dir.hpp"
#include "tests/support/test_database.hpp"

namespace loopscope::tests {

inline constexpr const char* kPsql = "/usr/bin/psql";

/// A plant for one test: a database of its own on the throw-away server, a copy of the one that
/// `loopscope migrate` made, with an empty historian, and a settings file. Everything is removed at
/// the end.
class Plant {
 public:
  Plant();

  /// Runs the program: loopscope COMMAND --config FILE REST...
  [[nodiscard]] ProgramResult loopscope(const std::string& command,
                                        const std::vector<std::string>& rest = {}) const;
  /// The same arguments, for a program in the background.
  [[nodiscard]] std::vector<std::string> command_line(const std::string& command) const;

  /// Rows of the last of these commands as psql -At prints them: columns separated by |, rows by
  /// line breaks, NULL as nothing.
  std::string sql(const std::string& query) const;

  /// Replaces the settings file; @CONNECTION@ stands for the database, @RESULTS@ for the same as
  /// its owner's login.
  void write_settings(const std::string& text) const;
  /// Settings with an object put in the place of the default one, e.g. schedule.
  [[nodiscard]] static std::string settings(const std::string& more = "");

  /// Writes a recording of `samples` rows of a noisy loop and imports it; returns its file.
  std::string import_loop(const std::string& name, std::size_t samples = 1000,
                          unsigned seed = 1) const;

  /// A loop of a simulated scenario, in historian and catalogue.
  void import_simulated(const std::string& name, const std::string& scenario,
                        const std::string& seed) const;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }
  [[nodiscard]] std::string settings_file() const { return folder_.path() / "loopscope.json"; }
  [[nodiscard]] const std::string& connection() const { return connection_; }
  [[nodiscard]] const TestDatabase& database() const { return database_; }

 private:
  TemporaryFolder folder_;
  TestDatabase database_;
  std::string connection_;
};

/// Where a daemon with this log says that its pages are, "http://127.0.0.1:9470"; empty when it
/// does not within 20 s.
[[nodiscard]] std::string pages_of(const std::filesystem::path& log);

/// An import lies where the hour before ended, and a daemon judges each hour when it has ended:
/// where less than `time` is left of this one, waits for the next. Import and daemon need the same
/// settle_s.
void wait_for_hour_with(std::chrono::seconds time);

/// Text of `samples` rows t_s,sp,pv,op of a first-order loop under noise.
[[nodiscard]] std::string noisy_loop_csv(std::size_t samples, unsigned seed);

}  // namespace loopscope::tests
