#include "tests/end_to_end/told_plant.hpp"

#include <stdexcept>

namespace loopscope::tests {

ToldPlant::ToldPlant() {
  const std::string roles = source_dir() / "deploy" / "roles.sql";
  const std::string story = source_dir() / "tests" / "support" / "told_plant.sql";
  const ProgramResult told = run_program({kPsql, "-X", "-d", plant_.connection(), "-q", "-f", roles,
                                          "-c", "SELECT loopscope.grant_rights()", "-f", story});
  if (told.exit_code != 0) throw std::runtime_error(told.err);
}

ProgramResult ToldPlant::ask(const std::string& group, const std::string& statement) const {
  return run_program({kPsql, "-X", "-d", plant_.connection(), "-v", "ON_ERROR_STOP=1", "-qAt", "-c",
                      "BEGIN", "-c", "SET LOCAL ROLE " + group, "-c", statement, "-c", "ROLLBACK"});
}

}  // namespace loopscope::tests
