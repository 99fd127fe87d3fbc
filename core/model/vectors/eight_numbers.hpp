#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace loopscope::core::model {

/// Series that go side by side: a whole vector of the widest processor, several of the others.
inline constexpr std::size_t kSideBySide = 8;

/// A number of each series, at one sample. What is done with each of them alone is the same to the
/// last digit, however wide the vectors are.
struct alignas(kSideBySide * sizeof(double)) EightNumbers {
  double numbers[kSideBySide];
  // Nothing at first: long series are written before they are read.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init,modernize-use-equals-default)
  EightNumbers() {}
  [[nodiscard]] double& operator[](std::size_t i) { return numbers[i]; }
  [[nodiscard]] double operator[](std::size_t i) const { return numbers[i]; }
};

/// The same numbers in a row, kSideBySide for each sample.
[[nodiscard]] inline std::span<const double> flat(std::span<const EightNumbers> series) {
  return {reinterpret_cast<const double*>(series.data()), series.size() * kSideBySide};
}
/// The first of them.
[[nodiscard]] inline double* first_of(std::span<EightNumbers> series) {
  return reinterpret_cast<double*>(series.data());
}

/// One of the series.
[[nodiscard]] inline std::vector<double> series_at(std::size_t place,
                                                   std::span<const EightNumbers> series) {
  std::vector<double> one;
  one.reserve(series.size());
  for (const EightNumbers& numbers : series) one.push_back(numbers[place]);
  return one;
}
/// A series in all places.
[[nodiscard]] inline std::vector<EightNumbers> eight_times(std::span<const double> series) {
  std::vector<EightNumbers> eight(series.size());
  for (std::size_t k = 0; k < series.size(); ++k)
    for (double& number : eight[k].numbers) number = series[k];
  return eight;
}

}  // namespace loopscope::core::model
