#include "daemon/report/programs/start_child.hpp"

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

#include "daemon/output/descriptor.hpp"

namespace loopscope::daemon {
namespace {

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> array;
  array.reserve(texts.size() + 1);
  for (std::string& text : texts) array.push_back(text.data());
  array.push_back(nullptr);
  return array;
}

/// What the child needs after fork(), where it may not allocate: other threads, which it has not,
/// may hold the lock.
struct Prepared {
  const char* program;
  char* const* arguments;
  char* const* environment;
  std::array<int, 3> streams;
  pid_t parent;
  int said;  ///< where it says by errno why it could not become the program
};

void forget_signals() {
  for (int number = 1; number < NSIG; ++number) ::signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
}

/// Everything above them is closed by exec. Out of their way first: a process that was started
/// without a standard input opens others in its place.
bool take_streams(const std::array<int, 3>& streams) {
  std::array<int, 3> above{};
  for (std::size_t k = 0; k < streams.size(); ++k)
    above.at(k) = ::fcntl(streams.at(k), F_DUPFD, STDERR_FILENO + 1);
  for (std::size_t k = 0; k < streams.size(); ++k)
    if (::dup2(above.at(k), static_cast<int>(k)) < 0) return false;
  return ::close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC) == 0;
}

/// By calls that are safe in a signal handler alone.
[[noreturn]] void become(const Prepared& prepared) {
  const bool ready = ::setpgid(0, 0) == 0 && ::prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 &&
                     take_streams(prepared.streams) && ::chdir("/") == 0;
  forget_signals();
  // The parent may have ended before prctl().
  if (ready && ::getppid() == prepared.parent)
    ::execve(prepared.program, prepared.arguments, prepared.environment);
  const int error = errno;
  (void)!::write(prepared.said, &error, sizeof error);
  ::_exit(127);
}

void require_started(bool started, int error, const std::filesystem::path& program) {
  if (!started)
    throw std::system_error(error, std::generic_category(), "cannot run " + program.string());
}

/// What the child has said; 0 when the program runs: exec has closed the other end.
int heard(const Descriptor& hears) {
  int error = 0;
  ssize_t count = -1;
  do count = ::read(hears.number(), &error, sizeof error);
  while (count < 0 && errno == EINTR);
  return count == sizeof error ? error : 0;
}

}  // namespace

pid_t start_child(const ChildStart& start) {
  std::vector<std::string> arguments = start.arguments;
  arguments.insert(arguments.begin(), start.program.string());
  std::vector<std::string> environment = start.environment;
  const std::vector<char*> argument_pointers = pointers(arguments);
  const std::vector<char*> environment_pointers = pointers(environment);
  std::array<int, 2> ends{};
  require_started(::pipe2(ends.data(), O_CLOEXEC) == 0, errno, start.program);
  const Descriptor hears(ends[0]);
  Descriptor said(ends[1]);
  Descriptor says(::fcntl(said.number(), F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
  said.close();
  const Prepared prepared{start.program.c_str(),
                          argument_pointers.data(),
                          environment_pointers.data(),
                          start.streams,
                          ::getpid(),
                          says.number()};
  const pid_t child = ::fork();
  if (child == 0) become(prepared);
  require_started(child > 0, errno, start.program);
  says.close();
  const int error = heard(hears);
  if (error == 0) return child;
  ::waitpid(child, nullptr, 0);
  require_started(false, error, start.program);
  return -1;
}

}  // namespace loopscope::daemon
