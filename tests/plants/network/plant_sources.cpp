#include <iostream>

#include "tests/plants/network/evidence_file.hpp"
#include "tests/plants/network/independent.hpp"
#include "tests/plants/network/options.hpp"
#include "tests/plants/network/run_plants.hpp"
#include "tests/plants/network/summary.hpp"
#include "tests/support/command_words.hpp"

namespace {

namespace network = loopscope::tests::network;

void run(const network::Options& options) {
  if (options.help) {
    std::cout << network::usage();
    return;
  }
  if (options.independent > 0) {
    std::cout << "plants of loops that share nothing with an event: "
              << network::plants_with_false_event(options.seed, options.independent,
                                                  options.threads)
              << " of " << options.independent << '\n';
    return;
  }
  const std::vector<network::Outcome> outcomes = network::run_plants(options);
  if (!options.evidence_file.empty())
    loopscope::tests::write_file(options.evidence_file, [&](std::ostream& file) {
      network::write_evidence(file, outcomes);
    });
  const network::Summary summary = network::summarise(outcomes);
  std::cout << (options.json ? network::json_of(summary) : network::table_of(summary));
}

}  // namespace

int main(int argc, char** argv) {
  return loopscope::tests::run_program(
      argc, argv, [](const auto& words) { run(network::read_options(words)); });
}
