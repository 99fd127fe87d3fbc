#include "tests/core/model/field_families.hpp"

#include <vector>

namespace loopscope::tests::model {

std::span<const FieldFamily> field_families() {
  static const std::vector<FieldFamily> all = [] {
    std::vector<FieldFamily> families;
    for (const auto some : {sticking_families(), healthy_families(), plant_sticking_families(),
                            plant_healthy_families()})
      families.insert(families.end(), some.begin(), some.end());
    return families;
  }();
  return all;
}

bool is_level(const FieldFamily& family) {
  return family.name.find("level") != std::string_view::npos;
}

FieldLoop record_of(const FieldFamily& family, std::uint64_t seed) {
  const auto place = static_cast<std::uint64_t>(&family - field_families().data());
  Draw draw(100'000 * (place + 1) + seed);
  return family.simulate(draw);
}

}  // namespace loopscope::tests::model
