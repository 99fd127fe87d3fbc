#pragma once

#include <string_view>
#include <vector>

namespace loopscope::daemon {

/// An industrial case of section 6. Its data are not public: the paper's figures stand alone, with
/// what this program would go by.
struct IndustrialCase {
  std::string_view section;
  std::string_view title;
  double ngi = 0.0;
  double nli = 0.0;
  std::string_view paper_cause;
  std::string_view answer;  ///< what in this program answers to it
};

[[nodiscard]] const std::vector<IndustrialCase>& industrial_cases();

}  // namespace loopscope::daemon
