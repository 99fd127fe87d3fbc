#include "core/model/residual_tests/test_residual.hpp"

#include <optional>
#include <utility>

#include "core/model/residual_tests/statistics/residual_context.hpp"
#include "core/model/residual_tests/tests/grid.hpp"
#include "core/model/residual_tests/tests/held.hpp"
#include "core/model/residual_tests/tests/op_direction.hpp"
#include "core/model/residual_tests/tests/op_dynamics.hpp"
#include "core/model/residual_tests/tests/op_level.hpp"
#include "core/model/residual_tests/tests/periodic.hpp"
#include "core/model/residual_tests/tests/response_level.hpp"
#include "core/model/residual_tests/tests/time_event.hpp"
#include "core/model/residual_tests/tests/time_gain.hpp"
#include "core/model/residual_tests/tests/time_spread.hpp"
#include "core/model/residual_tests/tests/white.hpp"

namespace loopscope::core::model {
namespace {

void add(std::optional<TestOutcome> answer, std::vector<TestOutcome>& answers) {
  if (answer) answers.push_back(std::move(*answer));
}

}  // namespace

std::vector<TestOutcome> test_residual(const ResidualView& view) {
  const std::optional<ResidualContext> questioned = prepare_questions(view);
  if (!questioned) return {};
  std::vector<TestOutcome> answers;
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
