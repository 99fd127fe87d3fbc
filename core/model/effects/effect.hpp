#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/record/loop_data.hpp"
#include "core/model/response/process_shape.hpp"
#include "core/model/results/explanation.hpp"

namespace loopscope::core::model {

/// What the columns of an effect are made from. Equal lengths.
struct Signals {
  std::span<const double> flow;      ///< % from the mean of op: op after the effects of the valve
  std::span<const double> response;  ///< the linear process's answer to it, of gain 1
  const ProcessShape& process;
};

class Effect;
class ExternalOscillation;
class ValveEffect;
using EffectPtr = std::shared_ptr<const Effect>;
using Column = std::vector<double>;

/// One effect that a loop model may lack. It adds to the model by bending the way from op to flow,
/// by columns that the least-squares fit weighs, or both.
class Effect {
 public:
  virtual ~Effect() = default;
  [[nodiscard]] virtual EffectKind kind() const = 0;

  /// The sample at which something moves that a single one-step error may show.
  [[nodiscard]] virtual std::optional<std::size_t> moment() const { return std::nullopt; }
  /// Itself, where it is a valve with friction or play; a wave.
  [[nodiscard]] virtual const ValveEffect* as_valve() const { return nullptr; }
  [[nodiscard]] virtual const ExternalOscillation* as_wave() const { return nullptr; }

  /// The way from op to flow, in place; both in % from the mean of op.
  virtual void shape_flow(std::span<double> /*flow*/) const {}

  /// How many columns add_columns() adds.
  [[nodiscard]] virtual std::size_t column_count() const { return 0; }
  virtual void add_columns(const Signals& /*signals*/, std::vector<Column>& /*columns*/) const {}

  /// The same effect with its nonlinear parameters moved a little, `scale` from 1 (coarse) down.
  [[nodiscard]] virtual std::vector<EffectPtr> neighbours(double /*scale*/) const { return {}; }

  /// In contract.md's words and units (Parameter::unit); `coefficients` are those of its columns,
  /// `gain` the process's, both in units of LoopData::pv_scale.
  [[nodiscard]] virtual std::vector<Parameter> parameters(const LoopData& data,
                                                          std::span<const double> coefficients,
                                                          double gain) const = 0;
  /// What leaves part of the same mark: the effect is claimed where each of these, in its place, is
  /// refuted by what it explains beyond them.
  [[nodiscard]] virtual std::vector<EffectPtr> plainer() const { return {}; }
  /// Whether such an effect does so much in a plant; beyond its bounds something else is at work.
  [[nodiscard]] virtual bool plausible(std::span<const double> /*coefficients*/,
                                       double /*gain*/) const {
    return true;
  }
  [[nodiscard]] virtual std::string_view law() const { return {}; }

  /// What the effect is, with its figures, in one sentence for an engineer.
  [[nodiscard]] virtual std::string words(std::span<const Parameter> parameters) const = 0;
};

}  // namespace loopscope::core::model
