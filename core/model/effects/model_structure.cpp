#include "core/model/effects/model_structure.hpp"

#include <utility>

namespace loopscope::core::model {

Structure with(Structure structure, EffectPtr effect) {
  structure.effects.push_back(std::move(effect));
  return structure;
}

Structure with_last(Structure structure, EffectPtr effect) {
  structure.effects.back() = std::move(effect);
  return structure;
}

Structure without_last(Structure structure) {
  structure.effects.pop_back();
  return structure;
}

}  // namespace loopscope::core::model
