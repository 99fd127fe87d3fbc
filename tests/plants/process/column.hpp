#pragma once

#include <array>

#include "tests/plants/process/delayed_lag.hpp"
#include "tests/plants/process/plan.hpp"

namespace loopscope::tests::process {

/// The column for methanol and water of Wood and Berry (Chem. Eng. Sci. 28, 1973): their transfer
/// matrix with dead times, feed included, about their operating point (lb/min, weight %). The
/// vessels, the condenser's pressure and the preheater of the feed are ours: balances of the same
/// flows.
class Column : public UnitProcess {
 public:
  enum Stream : std::size_t { kFeed, kReflux, kSteam, kDistillate, kBottoms, kCoolant };
  enum Upset : std::size_t {
    kInflow,
    kFeedContent,
    kCoolantTemperature,
    kSteamHeader,
    kWaterHeader,
    kFeedHead
  };
  enum Value : std::size_t { kTop, kBottom, kDrum, kBase, kPressure, kFeedTank };

  static constexpr double kFeedFlow = 2.45, kRefluxFlow = 1.95, kSteamFlow = 1.71;  // lb/min
  static constexpr double kFeedContent0 = 46.5, kTop0 = 96.25, kBottom0 = 0.515;    // weight %
  /// From the balance of methanol.
  static constexpr double kDistillateFlow =
      kFeedFlow * (kFeedContent0 - kBottom0) / (kTop0 - kBottom0);
  static constexpr double kBottomsFlow = kFeedFlow - kDistillateFlow;
  static constexpr double kVapour = kRefluxFlow + kDistillateFlow;
  static constexpr double kCoolantFlow = 40.0;  // lb/min; not published
  static constexpr double kPressure0 = 14.7;    // psia; not published
  static constexpr double kDrumFull = 12.0, kBaseFull = 16.0, kTankFull = 40.0;  // lb; ours

  explicit Column(double step_s);

  void step(const std::vector<double>& flows, const std::vector<double>& upsets,
            double step_s) override;
  [[nodiscard]] double value(std::size_t which) const override { return values_[which]; }

 private:
  void move_contents(double reflux, double steam, double feed, double feed_content);
  void move_vessels(const std::vector<double>& flows, const std::vector<double>& upsets,
                    double minutes);

  /// Of reflux, steam, feed flow, feed content on the top and on the bottom.
  std::array<DelayedLag, 4> on_top_, on_bottom_;
  DelayedLag down_;     ///< of liquid from the top and the feed to the base
  DelayedLag preheat_;  ///< of the feed, by the bottoms
  State<4> vessels_;
  std::array<double, 6> values_;
};

[[nodiscard]] PlantPlan draft_column(std::uint64_t seed);

}  // namespace loopscope::tests::process
