#include "core/model/questions/coupling.hpp"

#include "core/hos/analyse.hpp"
#include "core/model/phrases.hpp"

namespace loopscope::core::model {
namespace {

std::vector<Nomination> nominations_of(hos::Coupling coupling, double p) {
  std::vector<Nomination> nominations;
  const bool both = coupling == hos::Coupling::both;
  if (both || coupling == hos::Coupling::quadratic)
    for (const EffectKind effect :
         {EffectKind::process_nonlinearity, EffectKind::valve_characteristic})
      nominations.push_back({.effect = effect, .p = p});
  if (both || coupling == hos::Coupling::cubic)
    for (const EffectKind effect : {EffectKind::valve_stiction, EffectKind::valve_deadband})
      nominations.push_back({.effect = effect, .p = p});
  return nominations;
}

Answer answer_of(std::string_view question, double p, const std::string& statement) {
  return {{question, p, p <= kSignificant ? statement : std::string()}, {}};
}

}  // namespace

std::vector<Answer> ask_coupling(const Questioned& questioned, std::uint64_t seed) {
  const auto result = hos::analyse(questioned.view.innovation, hos::Settings{}, seed);
  std::vector<Answer> answers;
  if (result && result->nonlinear_p) {
    answers.push_back(answer_of("nonlinear", *result->nonlinear_p,
                                "Frequencies of the residual are coupled: " +
                                    std::string(hos::name(result->coupling)) + "."));
    if (*result->nonlinear_p <= kSignificant)
      answers.back().nominations = nominations_of(result->coupling, *result->nonlinear_p);
  }
  if (result && result->ngi_p)
    answers.push_back(answer_of("ngi", *result->ngi_p,
                                "The residual is not Gaussian: its mean squared bicoherence is " +
                                    in_digits(result->mean_bic2) + "."));
  return answers;
}

}  // namespace loopscope::core::model
