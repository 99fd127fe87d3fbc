// The whole path of `loopscope analyze`: bytes to CSV to window to diagnosis to JSON. The first
// byte holds the options, the rest is the file.

#include "daemon/recording/analyse_recording.hpp"
#include "daemon/text/failure.hpp"
#include "tests/fuzz/check_diagnosis.hpp"
#include "tests/fuzz/require.hpp"
#include "tests/fuzz/targets.hpp"

namespace loopscope::tests::fuzz {
namespace {

struct AnalyzeOptions {
  core::AnalysisSettings settings;
  std::optional<core::signal::OpRange> op_range;
  bool integrating = false;
};

AnalyzeOptions options_of(std::uint8_t bits) {
  AnalyzeOptions options;
  options.settings.fit_model = (bits & 1U) != 0;
  if ((bits & 2U) != 0) options.op_range = core::signal::OpRange{0.0, 100.0};
  options.integrating = (bits & 4U) != 0;
  if ((bits & 8U) != 0) options.settings.prepare.window_samples = 512;
  return options;
}

std::string analyse(const daemon::Recording& recording, const AnalyzeOptions& options) {
  const auto analysis = daemon::analyse_recording(recording, options.settings, options.op_range,
                                                  {.integrating = options.integrating});
  return check_diagnosis(analysis.input, analysis.diagnosis);
}

void check_analysis(const AnalyzeOptions& options, std::string_view text) {
  const daemon::Recording recording = daemon::parse_recording(text, "recording.csv");
  const std::string once = analyse(recording, options);
  // A model takes many times what the rest takes: most of these are not made twice.
  const bool twice = !options.settings.fit_model || text.size() % 4 == 0;
  if (twice) require(analyse(recording, options) == once, "the same bytes, the same result");
}

}  // namespace

int fuzz_analyze(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  try {
    check_analysis(options_of(data[0]), {reinterpret_cast<const char*>(data) + 1, size - 1});
  } catch (const daemon::Failure& failure) {
    require(failure.exit_code() == daemon::ExitCode::unusable_data,
            "a file that cannot be used has its own exit code");
  }
  return 0;
}

}  // namespace loopscope::tests::fuzz
