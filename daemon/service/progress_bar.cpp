#include "daemon/service/progress_bar.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <iostream>
#include <unistd.h>

namespace loopscope::daemon {
namespace {

constexpr std::size_t kBarWidth = 40;

}  // namespace

std::string progress_text(std::size_t done, std::size_t total, std::size_t width,
                          std::string_view unit) {
  const std::size_t filled = total == 0 ? width : std::min(done, total) * width / total;
  return fmt::format("[{}{}] {}/{} {}", std::string(filled, '#'), std::string(width - filled, '.'),
                     done, total, unit);
}

ProgressBar::ProgressBar(std::size_t total, std::string_view unit)
    : terminal_(isatty(STDERR_FILENO) == 1), total_(total), unit_(unit) {
  advance(0);
}

ProgressBar::~ProgressBar() {
  if (terminal_) std::cerr << '\n';
}

void ProgressBar::advance(std::size_t steps) {
  done_ += steps;
  if (terminal_) std::cerr << '\r' << progress_text(done_, total_, kBarWidth, unit_) << std::flush;
}

}  // namespace loopscope::daemon
