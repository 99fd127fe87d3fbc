#include "tests/fuzz/array_reader.hpp"

#include "tests/fuzz/require.hpp"

namespace loopscope::tests::fuzz {
namespace {

std::string take_quoted(std::string_view& text) {
  std::string element;
  for (text.remove_prefix(1); !text.empty() && text.front() != '"'; text.remove_prefix(1)) {
    if (text.front() == '\\') text.remove_prefix(1);
    require(!text.empty(), "a backslash stands before something");
    element += text.front();
  }
  require(!text.empty(), "every quote is closed");
  text.remove_prefix(1);
  return element;
}

std::optional<std::string> take_bare(std::string_view& text) {
  const std::string element(text.substr(0, text.find(',')));
  require(!element.empty(), "an empty element is quoted");
  require(element.find_first_of("{}\"\\ ") == std::string::npos, "a bare element is a plain word");
  text.remove_prefix(element.size());
  return element == "NULL" ? std::nullopt : std::optional(element);
}

}  // namespace

std::vector<std::optional<std::string>> read_array(std::string_view text) {
  require(text.size() >= 2 && text.front() == '{' && text.back() == '}', "an array has its braces");
  text = text.substr(1, text.size() - 2);
  std::vector<std::optional<std::string>> elements;
  while (!text.empty()) {
    elements.push_back(text.front() == '"' ? std::optional(take_quoted(text)) : take_bare(text));
    if (text.empty()) break;
    require(text.front() == ',' && text.size() > 1, "a comma stands between two elements");
    text.remove_prefix(1);
  }
  return elements;
}

}  // namespace loopscope::tests::fuzz
