#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "core/signal/raw_series.hpp"
#include "storage/connection_settings.hpp"
#include "storage/historian/source_layout.hpp"

namespace loopscope::storage {

/// The rows of one tag to be loaded.
struct TagRows {
  std::string tag;
  core::signal::RawSeries rows;  ///< NaN is written as NULL with bad quality
};

/// Loads recordings into a historian table (demo and tests) in one transaction: all rows or none.
/// Only into a plain narrow table (tag, time, value, quality): the tables of a vendor are his own.
/// Refuses (DatabaseError, give_up) when a tag already has rows in the span of its new ones, unless
/// `replace`, which deletes those first, and for a tag that the column's type cannot hold. Returns
/// the number of rows written. This and the next throw DatabaseError.
std::size_t import_rows(const ConnectionSettings& settings, const SourceLayout& layout,
                        std::span<const TagRows> tags, bool replace);

/// Creates the layout's table with its covering index if it does not exist (demo and tests); text
/// tags, double values, smallint quality. Plain narrow layouts only. Returns whether it was
/// created.
bool create_historian_table(const ConnectionSettings& settings, const SourceLayout& layout);

}  // namespace loopscope::storage
