#include "tests/plants/process/four_tanks.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::tests::process {
namespace {

constexpr double kGravity = 981.0;                                 // cm/s^2
constexpr std::array kTankAreas = {28.0, 32.0, 28.0, 32.0};        // cm^2
constexpr std::array kOutletAreas = {0.071, 0.057, 0.071, 0.057};  // cm^2
constexpr double kByHead = 0.5;  // of a pump's flow, by its sump's level

double outflow(std::size_t tank, double level) {
  return kOutletAreas[tank] * std::sqrt(2.0 * kGravity * std::max(0.0, level));
}

}  // namespace

FourTanks::FourTanks(const Setting& setting, double shared_suction)
    : setting_(setting),
      shared_suction_(shared_suction),
      levels_{setting.levels[0], setting.levels[1], setting.levels[2],
              setting.levels[3], kSumpLevel,        kSumpLevel},
      pumped_1_(setting.flow_1),
      pumped_2_(setting.flow_2) {}

State<6> FourTanks::slope(const State<6>& at, const std::vector<double>& flows,
                          const std::vector<double>& upsets) const {
  std::array<double, 4> out{};
  for (std::size_t tank = 0; tank < 4; ++tank) out[tank] = outflow(tank, at[tank]);
  const double q1 = flows[kPump1], q2 = flows[kPump2], transfer = flows[kTransfer];
  const double first = out[0] + upsets[kDraw3] + upsets[kSpill];
  const double second = out[1] + upsets[kDraw4];
  return {(setting_.to_1 * q1 + out[2] - out[0]) / kTankAreas[0],
          (setting_.to_2 * q2 + out[3] - out[1]) / kTankAreas[1],
          ((1.0 - setting_.to_2) * q2 - out[2] - upsets[kDraw3]) / kTankAreas[2],
          ((1.0 - setting_.to_1) * q1 - out[3] - upsets[kDraw4]) / kTankAreas[3],
          (first + flows[kMakeup] - q1 - transfer) / kSumpArea,
          (second + transfer - q2 - flows[kBleed]) / kSumpArea};
}

void FourTanks::step(const std::vector<double>& flows, const std::vector<double>& upsets,
                     double step_s) {
  levels_ =
      runge_kutta<6>(levels_, step_s, [&](const State<6>& at) { return slope(at, flows, upsets); });
  for (double& level : levels_) level = std::max(0.0, level);
  pumped_1_ = flows[kPump1];
  pumped_2_ = flows[kPump2];
}

/// The pumps have their sumps' heads and share a header; from the first sump water runs down.
double FourTanks::drive(std::size_t stream) const {
  const double rise_1 = levels_[kSump1] / kSumpLevel - 1.0;
  const double rise_2 = levels_[kSump2] / kSumpLevel - 1.0;
  if (stream == kPump1)
    return 1.0 + kByHead * rise_1 - shared_suction_ * (pumped_2_ / setting_.flow_2 - 1.0);
  if (stream == kPump2)
    return 1.0 + kByHead * rise_2 - shared_suction_ * (pumped_1_ / setting_.flow_1 - 1.0);
  if (stream == kTransfer) return std::sqrt(1.0 + std::max(-1.0, rise_1));
  return stream == kBleed ? 1.0 + kByHead * rise_2 : 1.0;
}

}  // namespace loopscope::tests::process
