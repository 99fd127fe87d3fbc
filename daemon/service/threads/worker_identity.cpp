#include "daemon/service/threads/worker_identity.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <thread>
#include <unistd.h>

namespace loopscope::daemon {
namespace {

constexpr std::size_t kWorkersPerCore = 2;
/// A batch that waits for its core behind more others may outlast its lease.
constexpr std::size_t kMostWorkersPerCore = 8;

}  // namespace

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

std::size_t core_count(const config::DaemonSettings& settings) {
  if (settings.workers > 0) return static_cast<std::size_t>(settings.workers);
  return std::max<std::size_t>(std::thread::hardware_concurrency(), 1);
}

std::size_t worker_count(const config::DaemonSettings& settings) {
  const std::size_t cores = core_count(settings);
  if (settings.batches_in_flight == 0) return kWorkersPerCore * cores;
  return std::clamp(static_cast<std::size_t>(settings.batches_in_flight), cores,
                    kMostWorkersPerCore * cores);
}

std::size_t workers_beside_comparison(const config::DaemonSettings& settings) {
  const std::size_t workers = worker_count(settings);
  return std::max<std::size_t>(workers - workers / core_count(settings), 1);
}

std::string process_name() {
  return fmt::format("{}/{}", host_name(), getpid());
}

std::string worker_name(std::size_t index) {
  return fmt::format("{}/{}", process_name(), index);
}

}  // namespace loopscope::daemon
