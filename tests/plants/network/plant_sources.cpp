#include <fstream>
#include <iostream>

#include "tests/plants/network/evidence_file.hpp"
#include "tests/plants/network/options.hpp"
#include "tests/plants/network/run_plants.hpp"
#include "tests/plants/network/summary.hpp"

namespace {

namespace network = loopscope::tests::network;

int run(const network::Options& options) {
  if (options.help) {
    std::cout << network::usage();
    return 0;
  }
  const std::vector<network::Outcome> outcomes = network::run_plants(options);
  if (!options.evidence_file.empty()) {
    std::ofstream file(options.evidence_file);
    network::write_evidence(file, outcomes);
    file.close();
    if (!file) {
      std::cerr << "error: cannot write, " << options.evidence_file
                << "\nHINT: name a file in a folder that is there and may be written\n";
      return 1;
    }
  }
  const network::Summary summary = network::summarise(outcomes);
  std::cout << (options.json ? network::json_of(summary) : network::table_of(summary));
  return 0;
}

}  // namespace

int main(int argc, char** argv) try {
  return run(network::read_options({argv + 1, argv + argc}));
} catch (const network::WrongUsage& wrong) {
  std::cerr << "error: " << wrong.what() << "\nHINT: --help shows the options\n";
  return 2;
} catch (const std::exception& fault) {
  std::cerr << "error: " << fault.what() << "\n";
  return 1;
}
