#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/hos/transforms/settings.hpp"

namespace loopscope::daemon {

/// What the paper concludes from the figures of an example.
enum class PaperDecision { gaussian, nonlinear };

/// A figure as printed, and what keeps ours from it where it does.
struct PaperFigure {
  std::optional<double> value;  ///< nullopt = the paper prints none
  std::string obstacle;         ///< shown only when the figure is not met
};

/// A peak that the paper reads off its plot, f1 >= f2, cycles per sample.
struct PaperPeak {
  double f1 = 0.0;
  double f2 = 0.0;
};

/// One numbered example of sections 4 and 5, in one reading of its settings.
struct Example {
  std::string section;   ///< e.g. "5.2"
  std::string title;     ///< names the reading where the paper leaves room for several
  std::string scenario;  ///< of `loopscope simulate`
  bool is_loop = false;  ///< section 5: the whole diagnosis runs as well
  core::hos::Settings settings;
  PaperDecision decision = PaperDecision::gaussian;
  PaperFigure ngi;
  PaperFigure nli;
  std::vector<PaperPeak> peaks;
  std::string paper_cause;  ///< what the paper finds wrong with a loop, in its words
  std::string remark;       ///< about the example as such; may be empty
};

/// Every numbered example, in the paper's order.
[[nodiscard]] const std::vector<Example>& paper_examples();

}  // namespace loopscope::daemon
