// Simulated repairs, diagnosed, stored and judged as the daemon does.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <thread>

#include "storage/results/schema/migrate.hpp"
#include "tests/plants/repair_score.hpp"
#include "tests/plants/run_repairs.hpp"
#include "tests/plants/store_repairs.hpp"
#include "tests/support/test_database.hpp"

namespace {

namespace repairs = loopscope::tests::repairs;
namespace storage = loopscope::storage;

struct Options {
  repairs::RepairPlan plan;
  std::string database;
  bool json = false;
  bool each = false;
};

storage::ConnectionSettings settings_for(const std::string& conninfo) {
  storage::ConnectionSettings settings;
  settings.conninfo = conninfo;
  settings.purpose = "results";
  return settings;
}

void print_each(const repairs::DiagnosedRepair& repair, const storage::MaintenanceRow& row) {
  std::cout << fmt::format("{} {} {}: {}: {}\n", repair.loop.name, repair.fault,
                           repairs::name(repair.word), row.word.value_or("none"), row.statement);
}

void run(const Options& options) {
  std::unique_ptr<loopscope::tests::TestDatabase> throw_away;
  if (options.database.empty()) throw_away = std::make_unique<loopscope::tests::TestDatabase>();
  const auto database =
      settings_for(throw_away ? throw_away->conninfo(throw_away->owner()) : options.database);
  storage::migrate(database);
  const auto done = repairs::run_repairs(options.plan);
  const auto rows = repairs::store_repairs(database, done);
  std::vector<repairs::JudgedRepair> judged;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    judged.push_back({done[i].word, repairs::word_of(rows[i].word.value_or(""))});
    if (options.each) print_each(done[i], rows[i]);
  }
  const repairs::RepairScore score = repairs::score(judged);
  std::cout << (options.json ? json_of(score) : table_of(score));
}

void add_options(CLI::App& program, Options& options) {
  options.plan.threads = std::max(1U, std::thread::hardware_concurrency());
  program.add_option("--seed", options.plan.seed, "First seed")->capture_default_str();
  program.add_option("--repairs", options.plan.repairs, "How many, the words in turn")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  program.add_option("--threads", options.plan.threads, "Threads")->check(CLI::PositiveNumber);
  program.add_option("--database", options.database,
                     "Empty database that keeps the rows (default: a throw-away one on the server "
                     "in LOOPSCOPE_TEST_DATABASE)");
  program.add_flag("--each", options.each, "One line for every repair");
  program.add_flag("--json", options.json, "One JSON object instead of a table");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program{"Judges simulated repairs, diagnosed and stored as the daemon does."};
  Options options;
  add_options(program, options);
  try {
    program.parse(argc, argv);
    run(options);
    return 0;
  } catch (const CLI::ParseError& wrong) {
    return program.exit(wrong) == 0 ? 0 : 2;
  } catch (const storage::DatabaseError& error) {
    std::cerr << "error: " << error.what() << "\nHINT: " << error.hint() << "\n";
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
  }
  return 1;
}
