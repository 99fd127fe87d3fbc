#include "daemon/commands/memory.hpp"
#include "daemon/commands/program.hpp"

int main(int argc, char** argv) {
  loopscope::daemon::keep_freed_memory();
  return loopscope::daemon::run_program(argc, argv);
}
