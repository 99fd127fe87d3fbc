#include "daemon/monitor/plain_line.hpp"

#include "storage/utf8.hpp"

namespace loopscope::daemon {
namespace {

constexpr std::string_view kCut = "...";

bool is_control(char byte) {
  constexpr unsigned char kDelete = 0x7f;
  const auto code = static_cast<unsigned char>(byte);
  return code < ' ' || code == kDelete;
}

}  // namespace

std::string plain_line(std::string_view text, std::size_t most_bytes) {
  std::string line = storage::make_storable(text);
  for (char& byte : line) {
    if (is_control(byte)) byte = ' ';
  }
  if (line.size() <= most_bytes) return line;
  line.resize(most_bytes - kCut.size());
  while (!storage::is_storable(line)) line.pop_back();  // the beginning of a character
  return line.append(kCut);
}

}  // namespace loopscope::daemon
