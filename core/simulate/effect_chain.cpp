#include "core/simulate/effect_chain.hpp"

#include <algorithm>

namespace loopscope::core::simulate {

EffectChain::EffectChain(std::span<const Effect> effects) {
  std::vector<Effect> ordered(effects.begin(), effects.end());
  std::ranges::stable_sort(ordered, {}, &Effect::index);
  for (const Effect& effect : ordered) {
    check(effect);
    std::visit([this](const auto& one) { add(one); }, effect);
  }
}

double EffectChain::run(Stages& stages, double value, double time_s) {
  for (Stage& stage : stages) {
    value = stage(value, time_s);
  }
  return value;
}

void EffectChain::add(const ValveStiction& stiction) {
  valve_.push_back(
      [valve = StickingValve(stiction)](double op, double) mutable { return valve.next(op); });
}

void EffectChain::add(const ValveDeadband& deadband) {
  valve_.push_back(
      [valve = ValveWithPlay(deadband)](double op, double) mutable { return valve.next(op); });
}

void EffectChain::add(const ValveSaturation& saturation) {
  valve_.push_back([saturation](double mv, double) { return limited_travel(saturation, mv); });
}

void EffectChain::add(const ValveCharacteristic& characteristic) {
  flow_.push_back([characteristic](double mv, double) { return flow_at(characteristic, mv); });
}

void EffectChain::add(const GainChange& change) {
  process_input_.push_back(
      [change](double flow, double time_s) { return flow * gain_factor(change, time_s); });
}

void EffectChain::add(const ProcessNonlinearity& nonlinearity) {
  process_output_.push_back(
      [nonlinearity](double answer, double) { return curved_answer(nonlinearity, answer); });
}

void EffectChain::add(const ExternalOscillation& oscillation) {
  load_.push_back([oscillation](double load, double time_s) {
    return load + disturbance_at(oscillation, time_s);
  });
}

void EffectChain::add(const LoadStep& step) {
  load_.push_back(
      [step](double load, double time_s) { return load + disturbance_at(step, time_s); });
}

void EffectChain::add(const SensorHold& hold) {
  sensor_.push_back(
      [sensor = HoldingSensor(hold)](double pv, double) mutable { return sensor.next(pv); });
}

void EffectChain::add(const SensorQuantisation& quantisation) {
  sensor_.push_back([quantisation](double pv, double) { return quantised(quantisation, pv); });
}

}  // namespace loopscope::core::simulate
