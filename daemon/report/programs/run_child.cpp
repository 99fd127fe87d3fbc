#include "daemon/report/programs/run_child.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>

#include "daemon/output/descriptor.hpp"
#include "daemon/report/programs/start_child.hpp"

namespace loopscope::daemon {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// How often `stop` and the patience are looked at.
constexpr milliseconds kPollSlice{50};
/// More than any report: whoever writes that much has gone mad.
constexpr std::size_t kMostBytes = std::size_t{256} * 1024 * 1024;
constexpr std::size_t kMostComplaint = 2000;

void require(int error, const std::filesystem::path& program) {
  if (error != 0)
    throw std::system_error(error, std::generic_category(), "cannot run " + program.string());
}

struct Pipe {
  Descriptor ours, theirs;
};

Pipe make_pipe(const std::filesystem::path& program) {
  std::array<int, 2> ends{};
  require(::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) == 0 ? 0 : errno, program);
  Pipe made{Descriptor(ends[0]), Descriptor(ends[1])};
  require(::fcntl(ends[1], F_SETFL, 0) == 0 ? 0 : errno, program);  // the child's end waits
  return made;
}

/// A file in memory: whoever reads it byte by byte from a pipe (gnuplot does) can open it by name
/// instead, and nobody has to be fed while he talks.
Descriptor input_file(std::string_view input, const std::filesystem::path& program) {
  Descriptor file(::memfd_create("input", MFD_CLOEXEC));
  require(file.open() ? 0 : errno, program);
  for (std::size_t at = 0; at < input.size();) {
    const ssize_t written = ::write(file.number(), input.data() + at, input.size() - at);
    require(written > 0 ? 0 : errno, program);
    at += static_cast<std::size_t>(written);
  }
  require(::lseek(file.number(), 0, SEEK_SET) == 0 ? 0 : errno, program);
  return file;
}

class Child {
 public:
  Child(const ChildCommand& command, std::stop_token stop)
      : command_(command), stop_(std::move(stop)) {
    const Descriptor in = input_file(command.input, command.program);
    Pipe out = make_pipe(command.program);
    Pipe error = make_pipe(command.program);
    pid_ = start_child(
        {command.program,
         command.arguments,
         {"PATH=/usr/local/bin:/usr/bin:/bin", "HOME=/nonexistent", "LC_ALL=C.UTF-8", "TZ=UTC"},
         {in.number(), out.theirs.number(), error.theirs.number()}});
    out_ = std::move(out.ours);
    error_ = std::move(error.ours);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (pid_ > 0) end();
  }

  ChildResult run() {
    while (out_.open() || error_.open()) {
      if (lost_patience()) return std::move(result_);
      receive_all();
    }
    return await_end();
  }

 private:
  /// Also of what it has started: the group is its own.
  void end() {
    ::kill(-pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }

  bool lost_patience() {
    result_.out_of_time = Clock::now() - begin_ > command_.patience;
    if (!result_.out_of_time && !stop_.stop_requested() && result_.out.size() <= kMostBytes)
      return false;
    end();
    return true;
  }

  void receive_all() {
    std::array<pollfd, 2> ready{pollfd{out_.number(), POLLIN, 0},
                                pollfd{error_.number(), POLLIN, 0}};
    if (::poll(ready.data(), ready.size(), static_cast<int>(kPollSlice.count())) <= 0) return;
    if (ready[0].revents != 0) receive(out_, result_.out, kMostBytes + 1);
    if (ready[1].revents != 0) receive(error_, result_.complaint, kMostComplaint);
  }

  /// What is beyond `most` is taken and dropped.
  static void receive(Descriptor& from, std::string& to, std::size_t most) {
    std::array<char, 65536> buffer{};
    const ssize_t count = ::read(from.number(), buffer.data(), buffer.size());
    if (count > 0)
      to.append(buffer.data(), std::min(static_cast<std::size_t>(count), most - to.size()));
    else if (count == 0 || (errno != EAGAIN && errno != EINTR))
      from.close();
  }

  ChildResult await_end() {
    int status = 0;
    while (::waitpid(pid_, &status, WNOHANG) == 0) {
      if (lost_patience()) return std::move(result_);
      std::this_thread::sleep_for(milliseconds(2));
    }
    ::kill(-pid_, SIGKILL);  // what it left running, if anything
    pid_ = -1;
    if (WIFEXITED(status)) result_.exit_code = WEXITSTATUS(status);
    return std::move(result_);
  }

  const ChildCommand& command_;
  std::stop_token stop_;
  Clock::time_point begin_ = Clock::now();
  pid_t pid_ = -1;
  Descriptor out_, error_;
  ChildResult result_;
};

}  // namespace

ChildResult run_child(const ChildCommand& command, const std::stop_token& stop) {
  return Child(command, stop).run();
}

std::optional<std::filesystem::path> find_program(std::string_view name,
                                                  std::string_view search_path) {
  for (std::size_t begin = 0; begin <= search_path.size();) {
    const std::size_t end = std::min(search_path.find(':', begin), search_path.size());
    const std::filesystem::path folder = search_path.substr(begin, end - begin);
    const std::filesystem::path program = folder / name;
    std::error_code unseen;  // a folder that may not be entered has no program for us
    if (folder.is_absolute() && std::filesystem::is_regular_file(program, unseen) &&
        ::access(program.c_str(), X_OK) == 0)
      return program;
    begin = end + 1;
  }
  return std::nullopt;
}

}  // namespace loopscope::daemon
