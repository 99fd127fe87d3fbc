#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/plants/process/evidence_lines.hpp"
#include "tests/plants/process/judgement_table.hpp"
#include "tests/plants/process/names.hpp"
#include "tests/support/command_words.hpp"
#include "tests/support/in_threads.hpp"

namespace {

namespace process = loopscope::tests::process;
using loopscope::tests::CommandWords;
using loopscope::tests::WrongUsage;

constexpr const char* kUsage =
    "process_sources --kind KIND [--seed N] [--plants N] [--cause CAUSE] [--threads N]\n"
    "                [--evidence FILE]\n"
    "Draws so many plants of one kind, their causes in turn (or one of them), and says in which\n"
    "core/plant finds the oscillation and ranks its source first.\n"
    "--evidence writes what the ranking weighs, for tests/plants/network/fit_weights.\n"
    "KIND: evaporator, reactor_recycle, column, four_tanks\n"
    "CAUSE: none, sticking_valve, dead_band, sawtooth_sensor, tight_loop, outside_wave\n";

struct Options {
  std::optional<process::PlantKind> kind;
  std::vector<process::Cause> causes = process::all_causes();
  std::uint64_t seed = 1;
  std::uint64_t plants = 60;
  std::uint64_t threads = 1;
  std::string evidence;
};

/// A name that there is not is wrong usage.
template <typename Value>
Value named(Value (*value)(const std::string&), const std::string& name) {
  try {
    return value(name);
  } catch (const std::invalid_argument& error) {
    throw WrongUsage(std::string(error.what()) + "\n" + kUsage);
  }
}

Options read_options(const std::vector<std::string>& words) {
  Options options;
  CommandWords left(words);
  while (!left.done()) {
    const std::string option = left.next();
    if (option == "--kind")
      options.kind = named(process::kind_named, left.value(option));
    else if (option == "--cause")
      options.causes = {named(process::cause_named, left.value(option))};
    else if (option == "--seed")
      options.seed = left.count(option, 1);
    else if (option == "--plants")
      options.plants = left.count(option, 1);
    else if (option == "--threads")
      options.threads = left.count(option, 1);
    else if (option == "--evidence")
      options.evidence = left.value(option);
    else
      throw WrongUsage(option + " is no option\n" + kUsage);
  }
  if (!options.kind) throw WrongUsage(std::string("--kind is missing\n") + kUsage);
  return options;
}

void write_evidence(std::ostream& out, const std::vector<process::Judgement>& judgements) {
  out << process::kEvidenceHeader << '\n';
  for (const process::Judgement& one : judgements)
    for (const std::string& line : one.evidence) out << line << '\n';
}

void run(const Options& options) {
  std::vector<process::Judgement> judgements(options.plants);
  loopscope::tests::in_threads(
      judgements.size(), static_cast<unsigned>(options.threads), [&](std::size_t k) {
        const std::size_t causes = options.causes.size();
        judgements[k] = process::judge_plant(*options.kind, options.causes[k % causes],
                                             options.seed + k / causes);
      });
  std::cout << process::table_of(judgements);
  if (!options.evidence.empty())
    loopscope::tests::write_file(options.evidence,
                                 [&](std::ostream& file) { write_evidence(file, judgements); });
}

}  // namespace

int main(int argc, char** argv) {
  return loopscope::tests::run_program(argc, argv,
                                       [](const auto& words) { run(read_options(words)); });
}
