#include <iostream>

#include "tests/effects/dump.hpp"
#include "tests/effects/field_draws.hpp"
#include "tests/effects/options.hpp"
#include "tests/effects/residual_tests.hpp"
#include "tests/effects/summary.hpp"
#include "tests/support/command_words.hpp"

namespace {

namespace effects = loopscope::tests::effects;

void list_kinds() {
  for (const effects::KindInfo& kind : effects::all_kinds()) {
    std::cout << kind.name << ":";
    for (const std::string& verdict : kind.verdicts) std::cout << " " << verdict;
    std::cout << "\n";
  }
  std::cout << "--without:";
  for (const auto mechanism : loopscope::core::model::all_mechanisms())
    std::cout << " " << name(mechanism);
  std::cout << "\n";
}

void dump(const effects::Options& options) {
  const effects::Record record = effects::generate(options.dump_kind, options.dump_seed,
                                                   options.plan.size, options.plan.noise);
  const auto write = [&](std::ostream& out) { effects::write_csv(out, record, options.with_mv); };
  if (options.dump_file == "-")
    write(std::cout);
  else
    loopscope::tests::write_file(options.dump_file, write);
  effects::write_truth(std::cerr, record.truth);
}

void run(const effects::Options& options) {
  if (options.help) {
    std::cout << effects::usage();
    return;
  }
  if (options.list) return list_kinds();
  if (!options.dump_kind.empty()) return dump(options);
  if (options.residual_tests) {
    std::cout << effects::passing_table(options.plan);
    return;
  }
  if (options.field) {
    std::cout << lines_of(effects::field_draws(options.plan));
    return;
  }
  if (!options.manifest.empty()) {
    std::cout << lines_of(effects::recorded(options.plan, options.manifest));
    return;
  }
  const auto outcomes = effects::run_draws(options.plan);
  if (options.records) {
    std::cout << effects::lines_of(options.plan, outcomes);
    return;
  }
  const effects::Summary summary = effects::summarise(options.plan, outcomes);
  std::cout << (options.json ? effects::json_of(summary) : effects::table_of(summary));
}

}  // namespace

int main(int argc, char** argv) {
  return loopscope::tests::run_program(
      argc, argv, [](const auto& words) { run(effects::read_options(words)); });
}
