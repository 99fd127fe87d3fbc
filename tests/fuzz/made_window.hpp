#pragma once

#include "core/diagnosis/analysis_settings.hpp"
#include "core/signal/loop_window.hpp"
#include "tests/fuzz/byte_source.hpp"

namespace loopscope::tests::fuzz {

/// A window and how it is to be analysed.
struct MadeWindow {
  core::signal::LoopWindow window;
  core::AnalysisSettings settings;
  bool integrating = false;
  bool fits = true;  ///< false: a series is shorter than pv, or the interval is no time
};

/// A window out of bytes: eight say how long it is, of which simulated loop, with which series and
/// settings; every further few name a series, a stretch of it and what becomes of that stretch.
[[nodiscard]] MadeWindow make_window(ByteSource& source);

}  // namespace loopscope::tests::fuzz
