#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "daemon/lab/commands/commands.hpp"
#include "daemon/lab/reproduce/reproduction.hpp"
#include "daemon/lab/reproduce/reproduction_json.hpp"
#include "daemon/lab/reproduce/reproduction_text.hpp"

namespace loopscope::daemon {

namespace {

struct ReproduceOptions {
  /// As many as the paper's examples were first checked with.
  std::size_t seeds = 60;
  bool json = false;
};

void reproduce(const ReproduceOptions& options) {
  const Reproduction reproduction = reproduce_paper(options.seeds);
  if (options.json) {
    std::cout << reproduction_json(reproduction).dump(2) << '\n';
  } else {
    std::cout << reproduction_text(reproduction);
  }
}

}  // namespace

void add_reproduce(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "reproduce", "Every numbered example of the paper: its figure beside ours");
  const auto options = std::make_shared<ReproduceOptions>();
  command.add_option("--seeds", options->seeds, "Records per example (default 60)")
      ->check(CLI::Range(1, 100'000));
  command.add_flag("--json", options->json, "One JSON object instead of text");
  command.callback([options] { reproduce(*options); });
}

}  // namespace loopscope::daemon
