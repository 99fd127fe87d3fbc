#include "tests/support/long_run.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

namespace loopscope::tests {
namespace {

// A fifth still shows what breaks a rate altogether: that is what a change is asked.
constexpr std::size_t kShortShare = 5;
// Of fewer a share says nothing: none of five happens to one in 400 of what should be seven of ten.
constexpr std::size_t kFewest = 5;

std::size_t whole_number(std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value == 0) {
    throw std::invalid_argument("LOOPSCOPE_RECORDS is " + std::string(text) +
                                ", not a whole number of at least 1");
  }
  return value;
}

}  // namespace

bool is_long_run() {
  const char* const text = std::getenv("LOOPSCOPE_LONG");
  return text != nullptr && std::string_view(text) != "0" && *text != '\0';
}

std::size_t all_records(std::size_t full) {
  const char* const wanted = std::getenv("LOOPSCOPE_RECORDS");
  return wanted != nullptr ? whole_number(wanted) : full;
}

std::size_t records(std::size_t full) {
  const std::size_t share = (full + kShortShare - 1) / kShortShare;
  return all_records(is_long_run() ? full : std::min(full, std::max(kFewest, share)));
}

}  // namespace loopscope::tests
