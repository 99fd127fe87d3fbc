#pragma once

#include "tests/plants/process/plan.hpp"

namespace loopscope::tests::process {

/// Reactor, column and recycle of Luyben (Ind. Eng. Chem. Res. 32, 1993): A -> B in a stirred tank,
/// what has not reacted comes back (lbmol/h, h). Flows, contents and rate are as published; heat,
/// jacket, vessels and pressure are ours (Btu, deg F, psia), and the column is lumped to its base
/// and drum with one factor of separation.
class ReactorRecycle : public UnitProcess {
 public:
  enum Stream : std::size_t {
    kFresh,
    kEffluent,
    kRecycle,
    kBottoms,
    kSteam,
    kReflux,
    kJacketWater,
    kCondenserWater
  };
  enum Upset : std::size_t {
    kFeedHead,
    kFeedContent,
    kFeedTemperature,
    kWaterTemperature,
    kActivity,
    kSteamHeader,
    kWaterHeader
  };
  enum Value : std::size_t {
    kReactorLevel,
    kTemperature,
    kJacket,
    kDrum,
    kBase,
    kTray,
    kPressure,
    kContent
  };

  static constexpr double kFreshFlow = 239.5, kFreshContent = 0.9;  // published
  static constexpr double kReactorHold = 1250.0, kRate_per_h = 0.34086;
  static constexpr double kEffluentFlow = 500.0, kEffluentContent = 0.5;
  static constexpr double kRecycleFlow = 260.5, kRecycleContent = 0.95;
  static constexpr double kBottomsFlow = 239.5, kBottomsContent = 0.0105;
  static constexpr double kRefluxFlow = 500.0, kSteamFlow = 11900.0;  // ours; steam in lb/h
  static constexpr double kJacketFlow = 93900.0, kCondenserFlow = 4000.0;
  static constexpr double kTemperature0 = 140.0, kJacket0 = 90.0, kTray0 = 190.0;
  static constexpr double kPressure0 = 25.0;
  static constexpr double kDrumHold = 63.0, kBaseHold = 83.0;  // lbmol, at 50 %

  struct Contents {
    double reactor, content, temperature, jacket, base, base_content, drum, drum_content, pressure;
  };

  /// `size` = of the reactor by the published one, with a rate as much higher: the same balance.
  explicit ReactorRecycle(double size);

  void step(const std::vector<double>& flows, const std::vector<double>& upsets,
            double step_s) override;
  [[nodiscard]] double value(std::size_t which) const override;

  [[nodiscard]] Contents nominal() const;
  /// Per hour.
  [[nodiscard]] Contents slope(const Contents& at, const std::vector<double>& flows,
                               const std::vector<double>& upsets) const;

 private:
  double size_;
  Contents now_;
};

[[nodiscard]] PlantPlan draft_reactor_recycle(std::uint64_t seed);

}  // namespace loopscope::tests::process
