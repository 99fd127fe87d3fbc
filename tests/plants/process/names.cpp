#include "tests/plants/process/names.hpp"

#include <stdexcept>

namespace loopscope::tests::process {
namespace {

template <typename Kind>
Kind find_named(const std::vector<Kind>& all, const std::string& name) {
  for (const Kind one : all)
    if (name_of(one) == name) return one;
  throw std::invalid_argument("unknown name " + name);
}

}  // namespace

std::string name_of(PlantKind kind) {
  static const std::vector<std::string> names = {"evaporator", "reactor_recycle", "column",
                                                 "four_tanks"};
  return names.at(static_cast<std::size_t>(kind));
}

std::string name_of(Cause cause) {
  static const std::vector<std::string> names = {
      "none", "sticking_valve", "dead_band", "sawtooth_sensor", "tight_loop", "outside_wave"};
  return names.at(static_cast<std::size_t>(cause));
}

const std::vector<PlantKind>& all_kinds() {
  static const std::vector<PlantKind> kinds = {PlantKind::evaporator, PlantKind::reactor_recycle,
                                               PlantKind::column, PlantKind::four_tanks};
  return kinds;
}

const std::vector<Cause>& all_causes() {
  static const std::vector<Cause> causes = {Cause::none,       Cause::sticking_valve,
                                            Cause::dead_band,  Cause::sawtooth_sensor,
                                            Cause::tight_loop, Cause::outside_wave};
  return causes;
}

PlantKind kind_named(const std::string& name) {
  return find_named(all_kinds(), name);
}

Cause cause_named(const std::string& name) {
  return find_named(all_causes(), name);
}

}  // namespace loopscope::tests::process
