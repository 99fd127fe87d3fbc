#include "core/diagnosis/evidence/evidence.hpp"

#include <stdexcept>

namespace loopscope::core {

std::string_view name(TestedOn tested_on) {
  switch (tested_on) {
    case TestedOn::error:
      return "error";
    case TestedOn::model_residual:
      return "model_residual";
  }
  throw std::invalid_argument("diagnosis: unknown record of the tests");
}

}  // namespace loopscope::core
