#include "core/model/question_residual.hpp"

#include <optional>
#include <utility>

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
#include "core/model/questions/time_spread.hpp"
#include "core/model/questions/white.hpp"

namespace loopscope::core::model {
namespace {

void add(std::optional<Answer> answer, std::vector<Answer>& answers) {
  if (answer) answers.push_back(std::move(*answer));
}

}  // namespace

std::vector<Answer> question_residual(const ResidualView& view) {
  const std::optional<Questioned> questioned = prepare_questions(view);
  if (!questioned) return {};
  std::vector<Answer> answers;
  add(ask_white(*questioned), answers);
  add(ask_op_dynamics(*questioned), answers);
  add(ask_op_direction(*questioned), answers);
  add(ask_op_level(*questioned), answers);
  add(ask_response_level(*questioned), answers);
  add(ask_time_gain(*questioned), answers);
  add(ask_time_spread(*questioned), answers);
  add(ask_time_event(*questioned), answers);
  add(ask_periodic(*questioned), answers);
  add(ask_grid(*questioned), answers);
  add(ask_held(*questioned), answers);
  return answers;
}

}  // namespace loopscope::core::model
