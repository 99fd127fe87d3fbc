#include "core/model/residual_tests/tests/coupling.hpp"

#include "core/hos/analyse.hpp"
#include "core/model/residual_tests/statistics/residual_context.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

TestOutcome answer_of(std::string_view question, double p, const std::string& statement) {
  return {{question, p, p <= kSignificant ? statement : std::string()}, {}};
}

std::string coupling_words(hos::Coupling coupling) {
  const std::string start = "The residual shows phase coupling of frequencies";
  if (coupling == hos::Coupling::quadratic) return start + ", quadratic.";
  if (coupling == hos::Coupling::cubic) return start + ", cubic.";
  return start + (coupling == hos::Coupling::both ? ", quadratic and cubic." : ".");
}

}  // namespace

std::vector<TestOutcome> test_coupling(std::span<const double> innovation, std::uint64_t seed) {
  if (!centred(innovation, kFewestAsked)) return {};
  const auto result = hos::analyse(innovation, hos::Settings{}, seed);
  std::vector<TestOutcome> answers;
  if (result && result->nonlinear_p) {
    answers.push_back(
        answer_of("nonlinear", *result->nonlinear_p, coupling_words(result->coupling)));
  }
  if (result && result->ngi_p)
    answers.push_back(answer_of("ngi", *result->ngi_p,
                                "The residual is not Gaussian: its mean squared bicoherence is " +
                                    text::number(result->mean_bic2) + "."));
  return answers;
}

}  // namespace loopscope::core::model
