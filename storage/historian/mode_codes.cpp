#include "storage/historian/mode_codes.hpp"

#include <algorithm>
#include <cmath>

#include "core/signal/loop_window.hpp"

namespace loopscope::storage {
namespace {

using core::signal::ControlMode;

bool among(const std::vector<double>& codes, double value) {
  return std::find(codes.begin(), codes.end(), value) != codes.end();
}

ControlMode mode_of(double value, const ModeCodes& codes) {
  if (among(codes.manual, value)) return ControlMode::manual;
  if (among(codes.automatic, value)) return ControlMode::automatic;
  return among(codes.cascade, value) ? ControlMode::cascade : ControlMode::unknown;
}

}  // namespace

void decode_modes(core::signal::RawSeries& rows, const ModeCodes& codes) {
  for (double& value : rows.value) {
    if (std::isfinite(value)) value = static_cast<double>(mode_of(value, codes));
  }
}

}  // namespace loopscope::storage
