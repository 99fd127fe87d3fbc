#include "tests/core/model/field_families.hpp"

#include <vector>

namespace loopscope::tests::model {

std::span<const FieldFamily> field_families() {
  static const std::vector<FieldFamily> all = [] {
    std::vector<FieldFamily> families(sticking_families().begin(), sticking_families().end());
    families.insert(families.end(), healthy_families().begin(), healthy_families().end());
    return families;
  }();
  return all;
}

}  // namespace loopscope::tests::model
