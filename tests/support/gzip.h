// Packs text as a gzip file, for tests that read packed files.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <string>

namespace bl::test {

inline std::string gzip_of(const std::string& text) {
  constexpr int kBest = 9, kGzipWindow = 15 + 16, kMemory = 9;
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, kBest, Z_DEFLATED, kGzipWindow, kMemory, Z_DEFAULT_STRATEGY), Z_OK);
  std::string bytes(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  bytes.resize(stream.total_out);
  deflateEnd(&stream);
  return bytes;
}

}  // namespace bl::test
