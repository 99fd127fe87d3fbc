#include "daemon/service/mode_codes.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/signal/loop_window.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::ControlMode;

/// Texts that config/ has found to be numbers.
std::vector<double> numbers(const std::vector<std::string>& texts) {
  std::vector<double> values;
  for (const std::string& text : texts) values.push_back(std::stod(text));
  return values;
}

bool among(const std::vector<double>& codes, double value) {
  return std::find(codes.begin(), codes.end(), value) != codes.end();
}

ControlMode mode_of(double value, const ModeCodes& codes) {
  if (among(codes.manual, value)) return ControlMode::manual;
  if (among(codes.automatic, value)) return ControlMode::automatic;
  return among(codes.cascade, value) ? ControlMode::cascade : ControlMode::unknown;
}

}  // namespace

ModeCodes mode_codes(const config::HistorianSettings& historian) {
  return {numbers(historian.manual_codes), numbers(historian.automatic_codes),
          numbers(historian.cascade_codes)};
}

void decode_modes(core::signal::RawSeries& rows, const ModeCodes& codes) {
  for (double& value : rows.value) {
    if (std::isfinite(value)) value = static_cast<double>(mode_of(value, codes));
  }
}

}  // namespace loopscope::daemon
