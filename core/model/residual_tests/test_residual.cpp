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
  const std::optional<ResidualContext> context = prepare_context(view);
  if (!context) return {};
  std::vector<TestOutcome> answers;
  add(test_white(*context), answers);
  add(test_op_dynamics(*context), answers);
  add(test_op_direction(*context), answers);
  add(test_op_level(*context), answers);
  add(test_response_level(*context), answers);
  add(test_time_gain(*context), answers);
  add(test_time_spread(*context), answers);
  add(test_time_event(*context), answers);
  add(test_periodic(*context), answers);
  add(test_grid(*context), answers);
  add(test_held(*context), answers);
  return answers;
}

}  // namespace loopscope::core::model
