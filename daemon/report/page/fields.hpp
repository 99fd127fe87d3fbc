#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace loopscope::daemon {

/// Text that is HTML already: the one thing that a template takes as it is. What is rendered is;
/// whatever else claims to be has to say so by this name.
struct Markup {
  std::string html;

  Markup() = default;
  explicit Markup(std::string ready) : html(std::move(ready)) {}
};

struct Field;
struct Value;

/// What a template, or one element of a list in it, is filled with.
using Fields = std::vector<Field>;
using List = std::vector<Value>;

/// What a name in a template stands for.
struct Value : std::variant<bool, std::int64_t, std::string, Markup, Fields, List> {
  Value(bool yes);
  Value(int number);
  Value(std::int64_t number);
  Value(const char* text);
  Value(std::string text);
  Value(std::string_view text);
  Value(Markup ready);
  Value(Fields fields);
  Value(List list);
  Value(const std::vector<std::string>& texts);
  Value(const std::vector<Markup>& parts);
};

struct Field {
  std::string_view name;  ///< a literal
  Value value;
};

/// Every element of `range` as `fields_of` tells it.
template <typename Range, typename FieldsOf>
[[nodiscard]] List rows(const Range& range, const FieldsOf& fields_of) {
  List made;
  for (const auto& element : range) made.emplace_back(fields_of(element));
  return made;
}

}  // namespace loopscope::daemon
