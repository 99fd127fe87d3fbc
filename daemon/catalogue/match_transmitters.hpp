#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "daemon/catalogue/assign_roles.hpp"

namespace loopscope::daemon {

/// A controller that has sp or op, but no pv.
struct BlindController {
  std::string path;  ///< its instrument's name as the tags spell it
  RoleAssignment* roles;
};

/// Measurements by the names of their instruments: FT-210 measures for FIC-210.
class Transmitters {
 public:
  /// A tag that is a measurement: `path` is its instrument's name, "area1/FT-210". Others than
  /// transmitters and indicators are left out.
  void add(const std::string& path, const std::string& tag);

  /// Gives each controller the tag of the transmitter with its measured variable, number and place
  /// (else of the indicator), where there is one of it and one controller for it. What may be meant
  /// but is not certain becomes ambiguous: two transmitters, two controllers, another suffix
  /// (FT-210A for FIC-210), another place. Returns the tags that were given.
  [[nodiscard]] std::vector<std::string> give(std::span<const BlindController> controllers) const;

 private:
  struct Measurement {
    std::string place, suffix, tag;
    bool transmitter;
  };
  /// Transmitters first.
  [[nodiscard]] std::vector<const Measurement*> fitting(const std::string& path,
                                                        bool exactly) const;
  [[nodiscard]] static const Measurement* certain(const std::vector<const Measurement*>& exact);
  [[nodiscard]] static std::vector<std::string> give_wanted(
      const std::map<std::string, std::vector<RoleAssignment*>>& wanted);

  /// By measured variable and number: "F 210".
  std::map<std::string, std::vector<Measurement>> measurements_;
};

}  // namespace loopscope::daemon
