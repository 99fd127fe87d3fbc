#include <fstream>
#include <iostream>

#include "tests/effects/dump.hpp"
#include "tests/effects/options.hpp"
#include "tests/effects/summary.hpp"

namespace {

namespace effects = loopscope::tests::effects;

int list_kinds() {
  for (const effects::KindInfo& kind : effects::all_kinds()) {
    std::cout << kind.name << ":";
    for (const std::string& verdict : kind.verdicts) std::cout << " " << verdict;
    std::cout << "\n";
  }
  return 0;
}

int dump(const effects::Options& options) {
  const effects::Record record =
      effects::generate(options.dump_kind, options.dump_seed, options.plan.size);
  if (options.dump_file == "-") {
    effects::write_csv(std::cout, record, options.with_mv);
  } else {
    std::ofstream file(options.dump_file);
    effects::write_csv(file, record, options.with_mv);
    file.close();
    if (!file) {
      std::cerr << "error: cannot write, " << options.dump_file
                << "\nHINT: name a file in a folder that is there and may be written\n";
      return 1;
    }
  }
  effects::write_truth(std::cerr, record.truth);
  return 0;
}

int run(const effects::Options& options) {
  if (options.help) {
    std::cout << effects::usage();
    return 0;
  }
  if (options.list) return list_kinds();
  if (!options.dump_kind.empty()) return dump(options);
  const effects::Summary summary =
      effects::summarise(options.plan, effects::run_draws(options.plan));
  std::cout << (options.json ? effects::json_of(summary) : effects::table_of(summary));
  return 0;
}

}  // namespace

int main(int argc, char** argv) try {
  return run(effects::read_options({argv + 1, argv + argc}));
} catch (const effects::WrongUsage& wrong) {
  std::cerr << "error: " << wrong.what() << "\nHINT: --help shows the options\n";
  return 2;
} catch (const std::exception& fault) {
  std::cerr << "error: " << fault.what() << "\n";
  return 1;
}
