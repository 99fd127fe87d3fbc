#pragma once

#include <string>

#include "tests/end_to_end/plant.hpp"

namespace loopscope::tests {

/// A plant in which every view has something to show (tests/support/told_plant.sql), asked with the
/// rights of the groups.
class ToldPlant {
 public:
  ToldPlant();

  /// Runs a statement with the rights of the group, e.g. "loopscope_reader", and undoes it. What
  /// psql prints, a row a line without a header; a failure as its exit code and words.
  [[nodiscard]] ProgramResult ask(const std::string& group, const std::string& statement) const;

  [[nodiscard]] const Plant& plant() const { return plant_; }

 private:
  Plant plant_;
};

}  // namespace loopscope::tests
