#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <limits>
#include <memory>
#include <thread>

#include "core/hos/analyse.hpp"
#include "daemon/lab/calibrate/calibration.hpp"
#include "daemon/lab/calibrate/calibration_json.hpp"
#include "daemon/lab/calibrate/calibration_text.hpp"
#include "daemon/lab/commands/commands.hpp"
#include "daemon/service/progress_bar.hpp"

namespace loopscope::daemon {
namespace {

struct CalibrateOptions {
  /// A false-alarm rate of 5 % is then known to about 3 % either way, in seconds.
  std::size_t records = 200;
  std::size_t threads = std::max(1U, std::thread::hardware_concurrency());
  std::size_t plants = 0;
  bool json = false;
};

RecordP nonlinear_p() {
  return [](std::span<const double> signal) {
    const auto result = core::hos::analyse(signal, {});
    constexpr double kNotComputed = std::numeric_limits<double>::quiet_NaN();
    return result ? result->nonlinear_p.value_or(kNotComputed) : kNotComputed;
  };
}

Calibration measure(const CalibrateOptions& options) {
  const auto& families = core::simulate::calibration_families();
  PlantSettings plants;
  plants.plants = options.plants;
  ProgressBar progress(families.size() * options.records + drawn_loops(plants), "records");
  const auto done = [&progress] { progress.advance(1); };
  Calibration result;
  result.records = options.records;
  result.families = tally_families(families, options.records, options.threads, done);
  if (options.plants > 0) {
    result.plants = judge_plants(plants, draw_plants(plants, options.threads, nonlinear_p, done));
  }
  return result;
}

void calibrate(const CalibrateOptions& options) {
  const Calibration calibration = measure(options);
  if (options.json) {
    std::cout << calibration_json(calibration).dump(2) << '\n';
  } else {
    std::cout << calibration_text(calibration);
  }
}

}  // namespace

void add_calibrate(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "calibrate", "False-alarm rates and power of the published and the calibrated tests");
  const auto options = std::make_shared<CalibrateOptions>();
  command.add_option("--records", options->records, "Records per family (default 200)")
      ->check(CLI::Range(1, 1'000'000));
  command.add_option("--plants", options->plants, "Plants of 10 000 loops to control (default 0)")
      ->check(CLI::Range(0, 1000));
  command.add_option("--threads", options->threads, "Threads to work in (default: one per core)")
      ->check(CLI::Range(1, 1024));
  command.add_flag("--json", options->json, "One JSON object instead of text");
  command.callback([options] { calibrate(*options); });
}

}  // namespace loopscope::daemon
