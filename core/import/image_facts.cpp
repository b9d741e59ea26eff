// Sizes from the headers of JPEG (ITU-T T.81) and PNG (ISO/IEC 15948), the rest from EXIF by libexif.
#include "core/import/image_facts.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <numbers>

#include <libexif/exif-data.h>
#include <nlohmann/json.hpp>

#include "core/base/mathematics.h"
#include "core/base/text.h"
#include "core/define/json_text.h"

namespace bl::importing {

namespace {

constexpr int kMostPixels = 65535;
constexpr double kFilmDiagonal = 43.2666153;  // of 35 mm film [mm]

std::uint32_t big_endian(std::string_view bytes, std::size_t at, int count) {
  std::uint32_t number = 0;
  for (int k = 0; k < count; ++k) number = number << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(k)]);
  return number;
}

Error cut_off(const char* what) {
  return {ErrorCode::parse, "", std::string("this ") + what + " ends before it says how large it is: the file is cut off"};
}

constexpr const char* kCutOff = "the file is cut off: its lower part is missing";

// A PNG ends with its chunk IEND, a JPEG with the marker EOI, after which cameras may append something of their own.
bool is_complete_png(std::string_view bytes) {
  return bytes.substr(bytes.size() < 64 ? 0 : bytes.size() - 64).find("IEND") != std::string_view::npos;
}

// From where the picture's own data begin: pictures in miniature within EXIF have an end of their own.
bool is_complete_jpeg(std::string_view bytes) {
  std::size_t at = 2;
  while (at + 2 <= bytes.size() && bytes[at] == '\xff') {
    const unsigned marker = big_endian(bytes, at + 1, 1);
    if (marker == 0xd9) return true;
    if (at + 4 > bytes.size()) return false;
    if (marker == 0xda) return bytes.find("\xff\xd9", at) != std::string_view::npos;
    at += marker == 0xff ? 1 : marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8) ? 2 : 2 + big_endian(bytes, at + 2, 2);
  }
  return false;
}

Result<void> read_png_size(std::string_view bytes, ImageFacts& facts) {
  if (bytes.size() < 24) return cut_off("PNG");
  facts.width = static_cast<int>(std::min<std::uint32_t>(big_endian(bytes, 16, 4), kMostPixels + 1));
  facts.height = static_cast<int>(std::min<std::uint32_t>(big_endian(bytes, 20, 4), kMostPixels + 1));
  return {};
}

// From segment to segment until one that begins a frame.
Result<void> read_jpeg_size(std::string_view bytes, ImageFacts& facts) {
  std::size_t at = 2;
  while (at + 4 <= bytes.size()) {
    if (bytes[at] != '\xff') return Error{ErrorCode::parse, "", "this JPEG is damaged: a segment does not begin where it should"};
    const unsigned marker = big_endian(bytes, at + 1, 1);
    if (marker == 0xff) {
      ++at;
      continue;
    }
    if (marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8)) {
      at += 2;
      continue;
    }
    const std::size_t length = big_endian(bytes, at + 2, 2);
    const bool is_frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (is_frame) {
      if (at + 9 > bytes.size()) break;
      facts.height = static_cast<int>(big_endian(bytes, at + 5, 2));
      facts.width = static_cast<int>(big_endian(bytes, at + 7, 2));
      return {};
    }
    if (marker == 0xda || marker == 0xd9 || length < 2) break;
    at += 2 + length;
  }
  return cut_off("JPEG");
}

// One tag of the picture, or nothing.
class Tags {
 public:
  explicit Tags(std::string_view bytes)
      : data_(exif_data_new_from_data(reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<unsigned>(bytes.size())),
              exif_data_unref) {}

  const ExifEntry* find(ExifIfd part, ExifTag tag) const {
    if (!data_) return nullptr;
    const ExifEntry* entry = exif_content_get_entry(data_->ifd[part], tag);
    return entry != nullptr && entry->data != nullptr ? entry : nullptr;
  }
  /// Text without the blanks around it. A copyright has two parts, the photographer's and the editor's: all of them, or the
  /// first.
  std::string text(ExifIfd part, ExifTag tag, bool has_parts = false) const {
    const ExifEntry* entry = find(part, tag);
    if (entry == nullptr || entry->format != EXIF_FORMAT_ASCII) return "";
    std::string_view rest(reinterpret_cast<const char*>(entry->data), entry->size);
    std::string text;
    do {
      const std::size_t end = std::min(rest.find('\0'), rest.size());
      std::string_view piece = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      while (!piece.empty() && (piece.back() == ' ' || piece.back() == '\n')) piece.remove_suffix(1);
      while (!piece.empty() && piece.front() == ' ') piece.remove_prefix(1);
      if (!piece.empty()) text.append(text.empty() ? "" : "; ").append(piece);
    } while (has_parts && !rest.empty());
    return is_sound_utf8(text) ? text : from_latin(text);
  }
  /// Whether a text was no UTF-8 and was read as Latin-1, which writers of EXIF used for long.
  bool has_guessed() const { return has_guessed_; }
  std::optional<double> number(ExifIfd part, ExifTag tag, unsigned index = 0) const {
    const ExifEntry* entry = find(part, tag);
    if (entry == nullptr || entry->components <= index) return std::nullopt;
    const unsigned size = exif_format_get_size(entry->format);
    if (size == 0 || entry->size < size * (index + 1)) return std::nullopt;
    const unsigned char* at = entry->data + size * index;
    const ExifByteOrder order = exif_data_get_byte_order(data_.get());
    if (entry->format == EXIF_FORMAT_SHORT) return exif_get_short(at, order);
    if (entry->format == EXIF_FORMAT_LONG) return exif_get_long(at, order);
    if (entry->format == EXIF_FORMAT_BYTE) return *at;
    if (entry->format != EXIF_FORMAT_RATIONAL) return std::nullopt;
    const ExifRational share = exif_get_rational(at, order);
    if (share.denominator == 0) return std::nullopt;
    return static_cast<double>(share.numerator) / share.denominator;
  }
  bool is_there() const { return data_ != nullptr; }

 private:
  std::string from_latin(std::string_view text) const {
    has_guessed_ = true;
    std::string out;
    for (const char c : text) {
      const auto code = static_cast<unsigned char>(c);
      if (code < 0x80) out += c;
      else if (code >= 0xa0) (out += static_cast<char>(0xc0 | (code >> 6))) += static_cast<char>(0x80 | (code & 0x3f));
    }
    return out;
  }
  static bool is_sound_utf8(std::string_view text) {
    for (std::size_t k = 0; k < text.size();) {
      const auto lead = static_cast<unsigned char>(text[k]);
      const std::size_t more = lead < 0x80 ? 0 : lead >= 0xf0 && lead < 0xf5 ? 3 : lead >= 0xe0 ? 2 : lead >= 0xc2 ? 1 : 9;
      if (more == 9 || lead >= 0xf5 || k + more >= text.size() + (more == 0 ? 1 : 0)) return false;
      for (std::size_t j = 1; j <= more; ++j)
        if ((static_cast<unsigned char>(text[k + j]) & 0xc0) != 0x80) return false;
      k += 1 + more;
    }
    return true;
  }
  std::unique_ptr<ExifData, decltype(&exif_data_unref)> data_;
  mutable bool has_guessed_ = false;
};

constexpr auto exif_tag(int number) { return static_cast<ExifTag>(number); }

// Degrees, minutes and seconds with a letter for the side; nothing where a part is missing or makes no sense.
std::optional<double> coordinate(const Tags& tags, int value, int side, char negative, double most) {
  const auto degrees = tags.number(EXIF_IFD_GPS, exif_tag(value), 0), minutes = tags.number(EXIF_IFD_GPS, exif_tag(value), 1),
             seconds = tags.number(EXIF_IFD_GPS, exif_tag(value), 2);
  const std::string letter = tags.text(EXIF_IFD_GPS, exif_tag(side));
  if (!degrees || !minutes || letter.empty()) return std::nullopt;
  const double size = *degrees + *minutes / 60 + seconds.value_or(0) / 3600;
  if (!(size <= most)) return std::nullopt;
  return letter.front() == negative ? -size : size;
}

// "2015:08:12 14:03:21" as "2015-08-12T14:03:21"; nothing where it is no date.
std::string date_of(std::string text) {
  if (text.size() < 19) return "";
  for (const std::size_t k : {0u, 1u, 2u, 3u, 5u, 6u, 8u, 9u, 11u, 12u, 14u, 15u, 17u, 18u})
    if (text[k] < '0' || text[k] > '9') return "";
  if (text.substr(0, 4) == "0000") return "";
  text[4] = text[7] = '-';
  text[10] = 'T';
  return text.substr(0, 19);
}

void read_place(const Tags& tags, ImageFacts& facts) {
  facts.latitude = coordinate(tags, EXIF_TAG_GPS_LATITUDE, EXIF_TAG_GPS_LATITUDE_REF, 'S', 90);
  facts.longitude = coordinate(tags, EXIF_TAG_GPS_LONGITUDE, EXIF_TAG_GPS_LONGITUDE_REF, 'W', 180);
  if (facts.latitude.has_value() != facts.longitude.has_value() || (facts.latitude == 0.0 && facts.longitude == 0.0)) {
    facts.latitude = facts.longitude = std::nullopt;
    facts.notes.emplace_back("its place is incomplete and was left out");
  }
  facts.altitude = tags.number(EXIF_IFD_GPS, exif_tag(EXIF_TAG_GPS_ALTITUDE));
  if (facts.altitude && tags.number(EXIF_IFD_GPS, exif_tag(EXIF_TAG_GPS_ALTITUDE_REF)).value_or(0) == 1) *facts.altitude *= -1;
  facts.bearing = tags.number(EXIF_IFD_GPS, exif_tag(EXIF_TAG_GPS_IMG_DIRECTION));
  if (facts.bearing && !(*facts.bearing >= 0 && *facts.bearing <= 360)) facts.bearing.reset();
  if (facts.bearing && tags.text(EXIF_IFD_GPS, exif_tag(EXIF_TAG_GPS_IMG_DIRECTION_REF)) == "M")
    facts.notes.emplace_back("its direction is against magnetic north and was taken as it is");
}

// Phones that take streets for maps write their compass into the description, beside much that is nobody's business: of such a
// record only the direction is kept.
void read_description(ImageFacts& facts) {
  if (facts.note.empty() || facts.note.front() != '{') return;
  const auto parsed = parse_json(facts.note);
  if (!parsed || !parsed->is_object()) return;
  const Json& record = *parsed;
  facts.note.clear();
  facts.notes.emplace_back("its description is a record of the camera and was left out");
  const auto heading = record.find("MAPCompassHeading");
  if (facts.bearing || heading == record.end() || !heading->is_object()) return;
  const auto found = heading->find("TrueHeading");
  if (found == heading->end() || !found->is_number()) return;
  const double bearing = found->get<double>();
  if (bearing >= 0 && bearing <= 360) facts.bearing = bearing;
}

}  // namespace

Result<ImageFacts> read_image_facts(std::string_view bytes) {
  ImageFacts facts;
  const bool is_jpeg = bytes.substr(0, 2) == "\xff\xd8", is_png = bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n";
  if (!is_jpeg && !is_png) return Error{ErrorCode::parse, "", "this is no picture that is known: pictures are JPEG or PNG files"};
  if (auto size = is_png ? read_png_size(bytes, facts) : read_jpeg_size(bytes, facts); !size) return size.error();
  if (facts.width < 1 || facts.height < 1 || facts.width > kMostPixels || facts.height > kMostPixels)
    return Error{ErrorCode::out_of_range, "",
                 "this picture says that it is " + std::to_string(facts.width) + " x " + std::to_string(facts.height) +
                     " pixels large; between 1 and 65535 are taken"};
  if (is_png ? !is_complete_png(bytes) : !is_complete_jpeg(bytes)) facts.notes.emplace_back(kCutOff);
  if (!is_jpeg) return facts;
  const Tags tags(bytes);
  if (!tags.is_there()) return facts;
  const double turn = tags.number(EXIF_IFD_0, EXIF_TAG_ORIENTATION).value_or(1);
  if (turn >= 1 && turn <= 8) facts.orientation = static_cast<int>(turn);
  else facts.notes.push_back("its orientation " + shortest(turn) + " is none, and it was left as it is");
  facts.taken = date_of(tags.text(EXIF_IFD_EXIF, EXIF_TAG_DATE_TIME_ORIGINAL));
  if (facts.taken.empty()) facts.taken = date_of(tags.text(EXIF_IFD_0, EXIF_TAG_DATE_TIME));
  facts.author = tags.text(EXIF_IFD_0, EXIF_TAG_ARTIST);
  facts.licence = tags.text(EXIF_IFD_0, EXIF_TAG_COPYRIGHT, true);
  facts.note = tags.text(EXIF_IFD_0, EXIF_TAG_IMAGE_DESCRIPTION);
  if (tags.has_guessed())
    facts.notes.emplace_back("its texts are not UTF-8 and were read as Latin-1: check letters with accents");
  read_place(tags, facts);
  read_description(facts);
  // The focal length on film gives the angle across its diagonal: it is the same for all formats.
  const auto focal = tags.number(EXIF_IFD_EXIF, EXIF_TAG_FOCAL_LENGTH_IN_35MM_FILM);
  if (focal && *focal > 1) {
    const double diagonal = mathematics::hypotenuse(facts.width, facts.height);
    facts.field_of_view =
        2 * mathematics::arc_tangent(0.5 * kFilmDiagonal * facts.seen_width() / diagonal / *focal) * 180 / std::numbers::pi;
  }
  return facts;
}

}  // namespace bl::importing
