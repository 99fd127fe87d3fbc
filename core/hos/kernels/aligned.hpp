#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace loopscope::core::hos {

/// One cache line, and the width of the widest vector register.
inline constexpr std::size_t kAlignment = 64;

/// Doubles in one cache line; rows are padded to a multiple of it.
inline constexpr std::size_t kLanes = kAlignment / sizeof(double);

/// Allocates on cache lines: FFTW plans made for one aligned buffer may then run on any other, and
/// no vector load straddles two lines. Numbers are not initialised unless a value is given.
template <typename T>
struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <typename U>
  AlignedAllocator(const AlignedAllocator<U>& /*other*/) {}
  T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new (count * sizeof(T), std::align_val_t{kAlignment}));
  }
  void deallocate(T* memory, std::size_t /*count*/) {
    ::operator delete (memory, std::align_val_t{kAlignment});
  }
  /// Leaves numbers as the memory is: spectra are written before they are read, and clearing two
  /// hundred kilobytes takes a tenth of a bicoherence.
  template <typename U>
  void construct(U* place) noexcept {
    ::new (static_cast<void*>(place)) U;
  }
  template <typename U>
  void construct(U* place, const U& value) {
    ::new (static_cast<void*>(place)) U(value);
  }
  friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) { return true; }
};

using AlignedVector = std::vector<double, AlignedAllocator<double>>;

}  // namespace loopscope::core::hos
