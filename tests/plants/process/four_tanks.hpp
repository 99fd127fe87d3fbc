#pragma once

#include "tests/plants/process/plan.hpp"

namespace loopscope::tests::process {

/// The quadruple tank of Johansson (IEEE Trans. Control Syst. Technol. 8, 2000), areas, valves and
/// operating points as published (cm, cm^3/s, s). Each pump draws from a sump of its own, which
/// takes what the lower tank lets go; the first sump is made up and fills the second, which is
/// bled.
class FourTanks : public UnitProcess {
 public:
  enum Stream : std::size_t { kPump1, kPump2, kMakeup, kTransfer, kBleed };
  enum Upset : std::size_t { kPumpPower, kTownHead, kDraw3, kDraw4, kBleedHead, kSpill };
  enum Value : std::size_t { kLevel1, kLevel2, kLevel3, kLevel4, kSump1, kSump2 };

  static constexpr double kBleedFlow = 6.0, kSumpLevel = 20.0;  // not published
  static constexpr double kSumpArea = 50.0;                     // cm^2; not published

  struct Setting {
    double to_1, to_2;             ///< share of each pump that goes to its lower tank
    double flow_1, flow_2;         ///< of the pumps, k v
    std::array<double, 4> levels;  ///< of the tanks
    [[nodiscard]] bool crossed() const { return to_1 + to_2 < 1.0; }
    /// What the first sump has left over.
    [[nodiscard]] double transfer() const {
      return kBleedFlow + (1.0 - to_2) * flow_2 - (1.0 - to_1) * flow_1;
    }
  };
  static constexpr Setting kMinimumPhase{
      0.70, 0.60, 3.33 * 3.00, 3.35 * 3.00, {12.4, 12.7, 1.8, 1.4}};
  static constexpr Setting kNonminimumPhase{
      0.43, 0.34, 3.14 * 3.15, 3.29 * 3.15, {12.6, 13.0, 4.8, 4.9}};

  /// `shared_suction` = fraction of a pump's flow that the other's nominal one takes away.
  FourTanks(const Setting& setting, double shared_suction);

  void step(const std::vector<double>& flows, const std::vector<double>& upsets,
            double step_s) override;
  [[nodiscard]] double value(std::size_t which) const override { return levels_[which]; }
  [[nodiscard]] double drive(std::size_t stream) const override;

  /// Of the four tanks and the two sumps, cm/s.
  [[nodiscard]] State<6> slope(const State<6>& at, const std::vector<double>& flows,
                               const std::vector<double>& upsets) const;

 private:
  Setting setting_;
  double shared_suction_;
  State<6> levels_;
  double pumped_1_, pumped_2_;
};

[[nodiscard]] PlantPlan draft_four_tanks(std::uint64_t seed);

}  // namespace loopscope::tests::process
