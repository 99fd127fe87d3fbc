#pragma once

#include "core/model/lane_basis.hpp"
#include "core/model/product_tiles.hpp"

namespace loopscope::core::model {
inline namespace LOOPSCOPE_PATH {

/// products() in tiles of up to `most` by `most` signals, as far as the registers go.
template <typename Number, std::size_t most>
class ProductTable {
 public:
  explicit ProductTable(const ProductTask& task)
      : task_(task),
        left_(bounded(task.left, task.rows)),
        right_(task.among_themselves ? left_ : bounded(task.right, task.rows)) {}

  void fill(Eigen::MatrixXd& all) const {
    const std::vector<Range> down = groups_of(left_), across = groups_of(right_);
    for (const Range& i : down) {
      for (const Range& j : across) {
        // Among themselves the lower triangle tells all.
        if (!task_.among_themselves || j.first <= i.first) put<most>(i, j, all);
      }
    }
  }

 private:
  /// Neighbours go together that are heard in the same place; others two by two.
  static std::vector<Range> groups_of(const Bounded& all) {
    std::vector<Range> groups;
    for (std::size_t at = 0; at < all.signals.size();) {
      std::size_t count = most;
      while (count > 1 && !fits(all, at, count)) count /= 2;
      groups.push_back({at, at + count});
      at += count;
    }
    return groups;
  }
  static bool fits(const Bounded& all, std::size_t first, std::size_t count) {
    if (first + count > all.signals.size()) return false;
    const auto same = [&](const Range& support) {
      return support.first == all.supports[first].first && support.end == all.supports[first].end;
    };
    return count <= 2 || std::all_of(&all.supports[first], &all.supports[first] + count, same);
  }

  /// The sizes become constants of the compiler, one after the other.
  template <std::size_t height>
  void put(const Range& i, const Range& j, Eigen::MatrixXd& all) const {
    if (i.size() == height) return put<height, most>(i, j, all);
    if constexpr (height > 1) put<height / 2>(i, j, all);
  }
  template <std::size_t height, std::size_t width>
  void put(const Range& i, const Range& j, Eigen::MatrixXd& all) const {
    if (j.size() == width) return put_tile<height, width>(i.first, j.first, all);
    if constexpr (width > 1) put<height, width / 2>(i, j, all);
  }

  template <std::size_t height, std::size_t width>
  void put_tile(std::size_t i, std::size_t j, Eigen::MatrixXd& all) const {
    const Range a = united(left_, i, height), b = united(right_, j, width);
    const std::size_t end = std::min(a.end, b.end);
    ProductTile<Number, height, width> tile;
    for (std::size_t range = std::max(a.first, b.first); range < end; ++range)
      tile.add(&left_.signals[i], &right_.signals[j], task_.rows[range]);
    for (std::size_t row = 0; row < height; ++row) {
      for (std::size_t column = 0; column < width; ++column)
        all(static_cast<Eigen::Index>(i + row), static_cast<Eigen::Index>(j + column)) =
            tile.sum(row, column);
    }
  }

  const ProductTask& task_;
  Bounded left_, right_;
};

template <typename Number, std::size_t most>
void fill_products(const ProductTask& task, Eigen::MatrixXd& all) {
  ProductTable<Number, most>(task).fill(all);
}

}  // namespace LOOPSCOPE_PATH
}  // namespace loopscope::core::model
