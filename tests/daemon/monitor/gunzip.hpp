#pragma once

#include <stdexcept>
#include <string>
#include <zlib.h>

namespace loopscope::daemon {

/// What was packed, 16 MB at most; throws std::runtime_error where that is no whole gzip file.
[[nodiscard]] inline std::string gunzip(std::string packed) {
  constexpr int kGzipOnly = 15 + 16;
  std::string text(std::size_t{16} * 1024 * 1024, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, kGzipOnly) != Z_OK) throw std::runtime_error("no memory for zlib");
  stream.next_in = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  const int result = inflate(&stream, Z_FINISH);
  text.resize(stream.total_out);
  inflateEnd(&stream);
  if (result != Z_STREAM_END || stream.avail_in != 0) throw std::runtime_error("no gzip file");
  return text;
}

}  // namespace loopscope::daemon
