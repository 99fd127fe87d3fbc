#include "tests/support/process.hpp"

#include <chrono>
#include <fstream>
#include <thread>

namespace loopscope::tests {
namespace {

/// Whether `asked` says yes within `seconds`.
template <typename Asked>
bool comes_true(double seconds, const Asked& asked) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!asked()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

/// Nobody may be there to bury whom we have not started ourselves.
bool has_ended(const std::string& pid) {
  std::ifstream status("/proc/" + pid + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("State:")) return line.find('Z') != std::string::npos;
  return true;
}

}  // namespace

std::string first_line_of(const std::filesystem::path& file, double seconds) {
  std::string line;
  (void)comes_true(seconds, [&] { return std::filesystem::exists(file); });
  std::ifstream stream(file);
  std::getline(stream, line);
  return line;
}

bool ends_within(const std::string& pid, double seconds) {
  return comes_true(seconds, [&] { return has_ended(pid); });
}

}  // namespace loopscope::tests
