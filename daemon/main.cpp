#include "daemon/program.hpp"

int main(int argc, char** argv) {
  return loopscope::daemon::run_program(argc, argv);
}
