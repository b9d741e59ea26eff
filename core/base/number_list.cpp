// Writing and reading digits of base 64, and hashing lists by blocks of them.
#include "core/base/number_list.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <type_traits>

namespace bl {

namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t kNone = 64;
// So many numbers fill whole blocks of the lanes, whatever number of digits each has.
constexpr std::size_t kTogether = TextLanes::kBlock;

template <class T>
using BitsOf = std::conditional_t<std::is_same_v<T, double>, std::uint64_t, std::uint32_t>;

template <class T>
constexpr std::size_t kPerNumber = std::is_same_v<T, double> ? 11 : 4;

constexpr std::array<std::uint8_t, 256> values_of_digits() {
  std::array<std::uint8_t, 256> values{};
  for (std::uint8_t& value : values) value = kNone;
  for (std::size_t d = 0; d < kDigits.size(); ++d) values[static_cast<unsigned char>(kDigits[d])] = static_cast<std::uint8_t>(d);
  return values;
}

template <class T>
void write(std::span<const T> numbers, char* at) {
  for (const T number : numbers) {
    BitsOf<T> bits = std::bit_cast<BitsOf<T>>(number);
    for (std::size_t d = 0; d < kPerNumber<T>; ++d, bits >>= 6) *at++ = kDigits[bits & 63];
  }
}

template <class T>
std::string written(std::span<const T> numbers) {
  std::string text(kPerNumber<T> * numbers.size(), '\0');
  write(numbers, text.data());
  return text;
}

template <class T>
std::optional<std::vector<T>> read(std::string_view text) {
  static constexpr std::array<std::uint8_t, 256> kValues = values_of_digits();
  if (text.size() % kPerNumber<T> != 0) return std::nullopt;
  std::vector<T> numbers;
  numbers.reserve(text.size() / kPerNumber<T>);
  for (std::size_t at = 0; at < text.size(); at += kPerNumber<T>) {
    BitsOf<T> bits = 0;
    for (std::size_t d = 0; d < kPerNumber<T>; ++d) {
      const std::uint8_t value = kValues[static_cast<unsigned char>(text[at + d])];
      if (value == kNone) return std::nullopt;
      bits |= static_cast<BitsOf<T>>(value) << (6 * d);
    }
    numbers.push_back(std::bit_cast<T>(bits));
  }
  return numbers;
}

}  // namespace

std::string digits_of(std::span<const double> numbers) { return written(numbers); }
std::string digits_of(std::span<const std::uint32_t> indices) { return written(indices); }
std::optional<std::vector<double>> numbers_of_digits(std::string_view text) { return read<double>(text); }
std::optional<std::vector<std::uint32_t>> indices_of_digits(std::string_view text) { return read<std::uint32_t>(text); }

template <class T>
NumberList<T>::NumberList() {
  static const std::shared_ptr<const Content> nothing = std::make_shared<const Content>();
  content_ = nothing;
}

template <class T>
NumberList<T>::NumberList(std::vector<T> numbers) {
  const auto content = std::make_shared<Content>();
  content->numbers = std::move(numbers);
  if constexpr (std::is_same_v<T, double>) {
    for (double& number : content->numbers) number = number == 0 ? 0.0 : number;
    content->is_finite = std::all_of(content->numbers.begin(), content->numbers.end(), [](double x) { return std::isfinite(x); });
  } else {
    assert(std::all_of(content->numbers.begin(), content->numbers.end(), [](T index) { return index <= kLargestIndex; }));
  }
  const std::span<const T> all(content->numbers);
  const std::size_t length = kPerNumber<T> * all.size();
  std::array<char, kPerNumber<T> * kTogether> digits;
  for (std::size_t at = 0; length >= kLongText && at < all.size(); at += kTogether) {
    const auto some = all.subspan(at, std::min(kTogether, all.size() - at));
    write(some, digits.data());
    const std::size_t filled = kPerNumber<T> * some.size();
    content->lanes.add({digits.data(), filled / TextLanes::kBlock * TextLanes::kBlock});
  }
  content_ = content;
}

template <class T>
bool NumberList<T>::operator==(const NumberList& other) const {
  return content_ == other.content_ || content_->numbers == other.content_->numbers;
}

template <class T>
void NumberList<T>::add_to(Hash& hash) const {
  const std::span<const T> all(content_->numbers);
  const std::size_t length = kPerNumber<T> * all.size();
  if (length < kLongText) return hash.add(std::string_view(written(all)));
  const std::string last = written(all.last(std::min(all.size(), TextLanes::kBlock)));
  content_->lanes.finish(hash, length, std::string_view(last).substr(last.size() - length % TextLanes::kBlock));
}

template class NumberList<double>;
template class NumberList<std::uint32_t>;

}  // namespace bl
