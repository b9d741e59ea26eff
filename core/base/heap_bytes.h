// How much memory of their own texts and lists take, about, for those who count what they keep.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace bl {

/// What the heap takes for a block beside its content, with the counters of an object that is shared [bytes].
inline constexpr std::size_t kBytesOfBlock = 32;

/// Short texts lie in the text itself.
inline std::size_t heap_bytes(const std::string& text) {
  return text.capacity() < sizeof(std::string) / 2 ? 0 : text.capacity() + kBytesOfBlock;
}
/// Of plain numbers or structs.
template <class T>
std::size_t heap_bytes(const std::vector<T>& list) {
  return list.capacity() == 0 ? 0 : list.capacity() * sizeof(T) + kBytesOfBlock;
}
inline std::size_t heap_bytes(const std::vector<std::string>& texts) {
  std::size_t bytes = texts.capacity() == 0 ? 0 : texts.capacity() * sizeof(std::string) + kBytesOfBlock;
  for (const std::string& text : texts) bytes += heap_bytes(text);
  return bytes;
}

}  // namespace bl
