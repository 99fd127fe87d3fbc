#include "tests/end_to_end/plant.hpp"

#include <cstdlib>
#include <fstream>
#include <random>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "tests/support/sql_connection.hpp"

namespace loopscope::tests {
namespace {

std::string as_lines(const TextRows& rows) {
  std::string text;
  for (const auto& row : rows) {
    if (!text.empty()) text += '\n';
    for (std::size_t k = 0; k < row.size(); ++k) text += (k == 0 ? "" : "|") + row[k];
  }
  return text;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    text.replace(at, from.size(), to);
    at += to.size();
  }
}

std::string settings_for(const std::string& connection, const std::string& text) {
  std::string filled = text;
  replace_all(filled, "@RESULTS@", with_key(connection, "user", make_owner(connection)));
  replace_all(filled, "@CONNECTION@", connection);
  return filled;
}

/// Through the program itself.
void migrate(const std::string& connection) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "loopscope.json";
  std::ofstream(file) << settings_for(connection, Plant::settings());
  const ProgramResult migrated = run_program({LOOPSCOPE_PROGRAM, "migrate", "--config", file});
  if (migrated.exit_code != 0) throw std::runtime_error("migrate failed: " + migrated.err);
}

/// Another program, another template: its migrations may differ.
TemplateDatabase migrated() {
  const auto built = std::filesystem::last_write_time(LOOPSCOPE_PROGRAM).time_since_epoch();
  return {"plant_template_" + std::to_string(std::abs(built.count())), migrate};
}

}  // namespace

Plant::Plant() : database_(migrated()), connection_(*test_server()) {
  replace_all(connection_, "dbname=postgres", "dbname=" + database_.name());
  write_settings(settings());
}

std::string Plant::settings(const std::string& more) {
  return R"({
  // a plant for one test
  "results": {"connection": "@RESULTS@"},
  "historians": [{"name": "plant", "connection": "@CONNECTION@"}])" +
         (more.empty() ? "" : ",\n  " + more) + "\n}\n";
}

void Plant::write_settings(const std::string& text) const {
  std::ofstream(settings_file()) << settings_for(connection_, text);
}

std::vector<std::string> Plant::command_line(const std::string& command) const {
  return {LOOPSCOPE_PROGRAM, command, "--config", settings_file()};
}

ProgramResult Plant::loopscope(const std::string& command,
                               const std::vector<std::string>& rest) const {
  std::vector<std::string> arguments = command_line(command);
  arguments.insert(arguments.end(), rest.begin(), rest.end());
  return run_program(arguments);
}

std::string Plant::sql(const std::string& query) const {
  return as_lines(database_.rows(query, ""));
}

std::string Plant::import_loop(const std::string& name, std::size_t samples, unsigned seed) const {
  const std::string file = folder() / ("recording_" + std::to_string(seed) + ".csv");
  std::ofstream(file) << noisy_loop_csv(samples, seed);
  const ProgramResult imported = loopscope("import", {"--create-table", "--loop", name, file});
  if (imported.exit_code != 0) throw std::runtime_error("import failed: " + imported.err);
  return file;
}

void Plant::import_simulated(const std::string& name, const std::string& scenario,
                             const std::string& seed) const {
  const std::string file = folder() / ("simulated_" + seed + ".csv");
  const ProgramResult simulated = run_program(
      {LOOPSCOPE_PROGRAM, "simulate", scenario, "--seed", seed, "--no-mv", "--out", file});
  if (simulated.exit_code != 0) throw std::runtime_error("simulate failed: " + simulated.err);
  const ProgramResult imported = loopscope("import", {"--create-table", "--loop", name, file});
  if (imported.exit_code != 0) throw std::runtime_error("import failed: " + imported.err);
}

std::string pages_of(const std::filesystem::path& log) {
  const std::regex words("health, metrics and pages: (http://[0-9.:]+)");
  for (int tries = 0; tries < 200; ++tries) {
    std::smatch match;
    const std::string text = content_of(log);
    if (std::regex_search(text, match, words)) return match[1];
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return {};
}

void wait_for_hour_with(std::chrono::seconds time) {
  const auto now = std::chrono::system_clock::now();
  const auto next = std::chrono::ceil<std::chrono::hours>(now);
  if (next - now < time) std::this_thread::sleep_until(next + std::chrono::seconds(1));
}

std::string noisy_loop_csv(std::size_t samples, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, 0.2);
  std::ostringstream text;
  text.precision(17);
  text << "t_s,sp,pv,op\n";
  double pv = 50.0;
  double op = 50.0;
  for (std::size_t k = 0; k < samples; ++k) {
    const double error = 50.0 - pv;
    op += 0.2 * error;
    pv = 0.8 * pv + 0.2 * (op + 0.3 * error) + noise(random);
    text << 10 * k << ",50," << pv << ',' << op << '\n';
  }
  return text.str();
}

}  // namespace loopscope::tests
