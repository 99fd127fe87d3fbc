#pragma once

#include <cstdint>
#include <optional>
#include <type_traits>

#include "storage/array_literal.hpp"
#include "storage/loop_work.hpp"

namespace loopscope::storage {

// What the columns of the higher-order statistics hold; NULL when there are none. Every loop has a
// record.

inline const core::Evidence& evidence(const CompletedLoop& loop) {
  return loop.record->diagnosis.evidence;
}

template <auto member>
void add_hos(ArrayLiteral& array, const CompletedLoop& loop) {
  const auto& hos = evidence(loop).hos;
  if (!hos) return array.add_null();
  using Value = std::remove_cvref_t<decltype(*hos.*member)>;
  if constexpr (std::is_integral_v<Value>) {
    array.add_integer(static_cast<std::int64_t>(*hos.*member));
  } else {
    array.add_number(*hos.*member);
  }
}

template <auto member>
void add_published(ArrayLiteral& array, const CompletedLoop& loop) {
  const auto& hos = evidence(loop).hos;
  hos ? array.add_boolean(hos->published.*member) : array.add_null();
}

inline void add_coupling(ArrayLiteral& array, const CompletedLoop& loop) {
  const auto& hos = evidence(loop).hos;
  hos ? array.add_text(core::hos::name(hos->coupling)) : array.add_null();
}

inline void add_tested_on(ArrayLiteral& array, const CompletedLoop& loop) {
  evidence(loop).hos ? array.add_text(core::name(evidence(loop).tested_on)) : array.add_null();
}

/// A figure of the innovations' noise.
template <auto member>
void add_noise(ArrayLiteral& array, const CompletedLoop& loop) {
  const auto& hos = evidence(loop).hos;
  hos && hos->noise ? array.add_number((*hos->noise).*member) : array.add_null();
}

}  // namespace loopscope::storage
