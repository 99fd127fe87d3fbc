#include "core/model/question_residual.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "core/model/questions/coupling.hpp"
#include "core/model/questions/grid.hpp"
#include "core/model/questions/held.hpp"
#include "core/model/questions/op_direction.hpp"
#include "core/model/questions/op_dynamics.hpp"
#include "core/model/questions/op_level.hpp"
#include "core/model/questions/periodic.hpp"
#include "core/model/questions/questioned.hpp"
#include "core/model/questions/response_level.hpp"
#include "core/model/questions/time_event.hpp"
#include "core/model/questions/time_gain.hpp"
#include "core/model/questions/time_level.hpp"
#include "core/model/questions/time_spread.hpp"
#include "core/model/questions/white.hpp"

namespace loopscope::core::model {
namespace {

void add(std::optional<Answer> answer, std::vector<Answer>& answers) {
  if (answer) answers.push_back(std::move(*answer));
}

/// An answer that is known under that name, or else what `ask` gives.
template <typename Ask>
void add(std::string_view name, const std::vector<Answer>& known, Ask ask,
         const Questioned& questioned, std::vector<Answer>& answers) {
  const auto same = [name](const Answer& answer) { return answer.question.name == name; };
  const auto at = std::ranges::find_if(known, same);
  add(at == known.end() ? ask(questioned) : std::optional(*at), answers);
}

std::vector<Answer> quick_answers(const Questioned& questioned, const std::vector<Answer>& known) {
  std::vector<Answer> answers;
  add(ask_white(questioned), answers);
  add(ask_op_dynamics(questioned), answers);
  add("op_direction", known, ask_op_direction, questioned, answers);
  add("op_level", known, ask_op_level, questioned, answers);
  add(ask_response_level(questioned), answers);
  add(ask_time_level(questioned), answers);
  add(ask_time_gain(questioned), answers);
  add(ask_time_spread(questioned), answers);
  add(ask_time_event(questioned), answers);
  add(ask_periodic(questioned), answers);
  add("grid", known, ask_grid, questioned, answers);
  add("held", known, ask_held, questioned, answers);
  return answers;
}

std::vector<Answer> first_answers(const Questioned& questioned) {
  std::vector<Answer> answers;
  add(ask_op_direction(questioned), answers);
  add(ask_op_level(questioned), answers);
  add(ask_grid(questioned), answers);
  add(ask_held(questioned), answers);
  return answers;
}

}  // namespace

std::vector<Answer> question_residual(const ResidualView& view, std::uint64_t seed,
                                      const std::vector<Answer>& known) {
  const std::optional<Questioned> questioned = prepare_questions(view);
  if (!questioned) return {};
  std::vector<Answer> answers = quick_answers(*questioned, known);
  for (Answer& answer : ask_coupling(*questioned, seed)) answers.push_back(std::move(answer));
  return answers;
}

std::vector<Answer> question_residual_quickly(const ResidualView& view) {
  const std::optional<Questioned> questioned = prepare_questions(view);
  return questioned ? quick_answers(*questioned, {}) : std::vector<Answer>();
}

std::vector<Answer> question_residual_first(const ResidualView& view) {
  const std::optional<Questioned> questioned = prepare_questions(view);
  return questioned ? first_answers(*questioned) : std::vector<Answer>();
}

}  // namespace loopscope::core::model
