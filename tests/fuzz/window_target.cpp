// core::diagnose on windows that no file brings about so easily: a simulated loop, damaged in ways
// that the bytes say (made_window.hpp), with the loop model.

#include <stdexcept>

#include "core/signal/window_digest.hpp"
#include "tests/fuzz/check_diagnosis.hpp"
#include "tests/fuzz/made_window.hpp"
#include "tests/fuzz/require.hpp"
#include "tests/fuzz/targets.hpp"

namespace loopscope::tests::fuzz {
namespace {

std::string analyse(const MadeWindow& made) {
  const daemon::InputFacts input{"window", made.window.size(), std::nullopt, nullptr, nullptr};
  const core::LoopFacts facts{made.integrating, core::signal::window_seed(made.window)};
  return check_diagnosis(input, core::diagnose(made.window, made.settings, facts));
}

void check_window(const MadeWindow& made) {
  const std::string digest = core::signal::window_digest(made.window, "");
  const std::string once = analyse(made);
  const bool twice = !made.settings.fit_model || made.window.size() % 4 == 0;
  if (twice) require(analyse(made) == once, "the same window, the same result");
  require(core::signal::window_digest(made.window, "") == digest, "the window stays as it is");
}

}  // namespace

int fuzz_window(const std::uint8_t* data, std::size_t size) {
  ByteSource source(data, size);
  const MadeWindow made = make_window(source);
  try {
    check_window(made);
    require(made.fits, "series of different lengths are refused");
  } catch (const std::invalid_argument&) {
    require(!made.fits, "a window that fits is analysed");
  }
  return 0;
}

}  // namespace loopscope::tests::fuzz
