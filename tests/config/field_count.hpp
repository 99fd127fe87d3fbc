#pragma once

#include <cstddef>

namespace loopscope::config::tests {

/// Stands for a value of any type in an unevaluated initialiser.
struct Anything {
  template <typename T>
  operator T&() const&&;
};

/// Number of fields of an aggregate: how many initialisers it takes. Lets a test notice a field
/// that nobody has put into the table of settings.
template <typename Aggregate, typename... Fields>
consteval std::size_t field_count() {
  if constexpr (requires { Aggregate{Fields{}..., Anything{}}; })
    return field_count<Aggregate, Fields..., Anything>();
  else
    return sizeof...(Fields);
}

}  // namespace loopscope::config::tests
