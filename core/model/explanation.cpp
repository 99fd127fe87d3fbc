#include "core/model/explanation.hpp"

namespace loopscope::core::model {

std::string_view name(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::one_step:
      return "one_step";
    case ErrorKind::simulation:
      return "simulation";
  }
  return "";
}

}  // namespace loopscope::core::model
