#include "core/diagnosis/verdict.hpp"

#include <array>
#include <utility>

namespace loopscope::core::diagnosis {
namespace {

constexpr std::array kNames{
    std::pair{VerdictCode::healthy, std::string_view{"healthy"}},
    std::pair{VerdictCode::valve_stiction, std::string_view{"valve_stiction"}},
    std::pair{VerdictCode::valve_deadband, std::string_view{"valve_deadband"}},
    std::pair{VerdictCode::valve_saturation, std::string_view{"valve_saturation"}},
    std::pair{VerdictCode::valve_characteristic, std::string_view{"valve_characteristic"}},
    std::pair{VerdictCode::valve_oversized, std::string_view{"valve_oversized"}},
    std::pair{VerdictCode::process_nonlinearity, std::string_view{"process_nonlinearity"}},
    std::pair{VerdictCode::external_disturbance, std::string_view{"external_disturbance"}},
    std::pair{VerdictCode::process_change, std::string_view{"process_change"}},
    std::pair{VerdictCode::sensor_fault, std::string_view{"sensor_fault"}},
    std::pair{VerdictCode::tight_tuning, std::string_view{"tight_tuning"}},
    std::pair{VerdictCode::sluggish_tuning, std::string_view{"sluggish_tuning"}},
    std::pair{VerdictCode::nonlinear_unexplained, std::string_view{"nonlinear_unexplained"}},
    std::pair{VerdictCode::unexplained, std::string_view{"unexplained"}},
    std::pair{VerdictCode::insufficient_data, std::string_view{"insufficient_data"}},
};

constexpr auto kCodes = [] {
  std::array<VerdictCode, kNames.size()> codes{};
  for (std::size_t k = 0; k < codes.size(); ++k) codes[k] = kNames[k].first;
  return codes;
}();

}  // namespace

std::string_view name(VerdictCode code) {
  for (const auto& [known, text] : kNames) {
    if (known == code) return text;
  }
  return "insufficient_data";
}

std::optional<VerdictCode> verdict_code(std::string_view name) {
  for (const auto& [code, text] : kNames) {
    if (text == name) return code;
  }
  return std::nullopt;
}

std::span<const VerdictCode> all_verdict_codes() {
  return kCodes;
}

}  // namespace loopscope::core::diagnosis
