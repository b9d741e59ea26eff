// GeoTIFF from memory by libtiff and libgeotiff; their messages are caught and become ours.
#include <geotiff.h>
#include <geotiffio.h>
#include <tiffio.h>
#include <xtiffio.h>

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>

#include "core/base/stop_check.h"
#include "core/base/text.h"
#include "core/import/context_shape.h"
#include "core/import/local_frame.h"
#include "core/import/terrain_grid.h"

namespace bl::importing {

namespace {

constexpr std::size_t kMostPacking = 1000;  // bytes of pixels for each byte of the file, as deflate packs at most
constexpr std::uint32_t kNodataTag = 42113, kScaleTag = 33550, kTiepointTag = 33922, kMatrixTag = 34264;

// A file in memory as libtiff wants to see it.
struct MemoryFile {
  std::string_view bytes;
  std::uint64_t at = 0;
  std::string message;  // the first error that libtiff told
};

tmsize_t read_some(thandle_t handle, void* target, tmsize_t size) {
  auto& file = *static_cast<MemoryFile*>(handle);
  if (size < 0 || file.at >= file.bytes.size()) return 0;
  const std::size_t count = std::min<std::size_t>(static_cast<std::size_t>(size), file.bytes.size() - file.at);
  std::memcpy(target, file.bytes.data() + file.at, count);
  file.at += count;
  return static_cast<tmsize_t>(count);
}
tmsize_t write_none(thandle_t, void*, tmsize_t) { return 0; }
toff_t seek(thandle_t handle, toff_t offset, int whence) {
  auto& file = *static_cast<MemoryFile*>(handle);
  file.at = whence == SEEK_SET ? offset : whence == SEEK_CUR ? file.at + offset : file.bytes.size() + offset;
  return file.at;
}
int close_none(thandle_t) { return 0; }
toff_t size_of(thandle_t handle) { return static_cast<MemoryFile*>(handle)->bytes.size(); }

int remember(TIFF*, void* user, const char*, const char* format, va_list arguments) {
  auto& message = static_cast<MemoryFile*>(user)->message;
  char text[256];
  std::vsnprintf(text, sizeof text, format, arguments);
  if (message.empty()) message = text;
  return 1;
}
int ignore(TIFF*, void*, const char*, const char*, va_list) { return 1; }

struct Closing {
  void operator()(TIFF* tiff) const { XTIFFClose(tiff); }
};
using Tiff = std::unique_ptr<TIFF, Closing>;

Tiff open(MemoryFile& file) {
  XTIFFInitialize();
  TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
  TIFFOpenOptionsSetErrorHandlerExtR(options, remember, &file);
  TIFFOpenOptionsSetWarningHandlerExtR(options, ignore, nullptr);
  Tiff tiff(TIFFClientOpenExt("grid", "rm", &file, read_some, write_none, seek, close_none, size_of, nullptr, nullptr, options));
  TIFFOpenOptionsFree(options);
  return tiff;
}

std::string crs_of(TIFF* tiff) {
  GTIF* keys = GTIFNew(tiff);
  if (keys == nullptr) return {};
  unsigned short model = 0, code = 0;
  GTIFKeyGetSHORT(keys, GTModelTypeGeoKey, &model, 0, 1);
  const bool is_found =
      GTIFKeyGetSHORT(keys, model == ModelTypeProjected ? ProjectedCSTypeGeoKey : GeographicTypeGeoKey, &code, 0, 1) == 1;
  GTIFFree(keys);
  constexpr unsigned short kUserDefined = 32767;
  return is_found && code > 0 && code != kUserDefined ? tidy_crs_name("EPSG:" + std::to_string(code)) : std::string();
}

// [m]; 0 where the file does not say.
double height_unit_of(TIFF* tiff) {
  GTIF* keys = GTIFNew(tiff);
  if (keys == nullptr) return 0;
  unsigned short code = 0;
  const bool is_found = GTIFKeyGetSHORT(keys, VerticalUnitsGeoKey, &code, 0, 1) == 1;
  GTIFFree(keys);
  if (!is_found) return 0;
  return code == Linear_Meter ? 1 : code == Linear_Foot ? 0.3048 : code == Linear_Foot_US_Survey ? 1200.0 / 3937 : 0;
}

bool is_pixel_a_point(TIFF* tiff) {
  GTIF* keys = GTIFNew(tiff);
  if (keys == nullptr) return false;
  unsigned short kind = RasterPixelIsArea;
  GTIFKeyGetSHORT(keys, GTRasterTypeGeoKey, &kind, 0, 1);
  GTIFFree(keys);
  return kind == RasterPixelIsPoint;
}

Result<void> place(TIFF* tiff, TerrainGrid& grid) {
  std::uint16_t count = 0;
  double* numbers = nullptr;
  double x = 0, y = 0, column = 0, row = 0;
  if (TIFFGetField(tiff, kScaleTag, &count, &numbers) == 1 && count >= 2) {
    grid.cell_x = numbers[0];
    grid.cell_y = numbers[1];
    if (TIFFGetField(tiff, kTiepointTag, &count, &numbers) != 1 || count < 6)
      return Error{ErrorCode::missing, "GeoTIFF tags", "The file has a pixel scale but no tie point: its place is not known."};
    column = numbers[0], row = numbers[1], x = numbers[3], y = numbers[4];
  } else if (TIFFGetField(tiff, kMatrixTag, &count, &numbers) == 1 && count == 16 && numbers[1] == 0 && numbers[4] == 0) {
    grid.cell_x = numbers[0];
    grid.cell_y = -numbers[5];
    x = numbers[3], y = numbers[7];
  } else {
    return Error{
        ErrorCode::missing, "GeoTIFF tags",
        "The picture has no place on Earth (no pixel scale and tie point), or is turned: export it as a GeoTIFF with north up."};
  }
  if (!(grid.cell_x > 0) || !(grid.cell_y > 0) || !std::isfinite(x) || !std::isfinite(y) || !std::isfinite(column) ||
      !std::isfinite(row))
    return Error{ErrorCode::out_of_range, "GeoTIFF tags", "The size of the cells must be more than 0, with north up."};
  const double half = is_pixel_a_point(tiff) ? 0 : 0.5;
  grid.west = x + (half - column) * grid.cell_x;
  grid.north = y - (half - row) * grid.cell_y;
  return {};
}

// How numbers of the file become doubles.
struct Sample {
  std::uint16_t bits = 8, format = SAMPLEFORMAT_UINT, per_pixel = 1;

  template <class T>
  static double as(const unsigned char* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return static_cast<double>(value);
  }
  double read(const unsigned char* at) const {
    if (format == SAMPLEFORMAT_IEEEFP) return bits == 32 ? as<float>(at) : as<double>(at);
    if (format == SAMPLEFORMAT_INT)
      return bits == 8    ? as<std::int8_t>(at)
             : bits == 16 ? as<std::int16_t>(at)
             : bits == 32 ? as<std::int32_t>(at)
                          : as<std::int64_t>(at);
    return bits == 8    ? as<std::uint8_t>(at)
           : bits == 16 ? as<std::uint16_t>(at)
           : bits == 32 ? as<std::uint32_t>(at)
                        : as<std::uint64_t>(at);
  }
  bool is_known() const {
    const bool is_whole = format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_INT;
    return (is_whole && (bits == 8 || bits == 16 || bits == 32 || bits == 64)) ||
           (format == SAMPLEFORMAT_IEEEFP && (bits == 32 || bits == 64));
  }
};

// Does a block lie behind the end of the file, or the list that says where they lie?
bool is_cut_off(TIFF* tiff, const MemoryFile& file) {
  const std::uint32_t blocks = TIFFIsTiled(tiff) != 0 ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff);
  for (std::uint32_t k = 0; k < blocks; ++k) {
    const std::uint64_t begin = TIFFGetStrileOffset(tiff, k), size = TIFFGetStrileByteCount(tiff, k);
    if (begin > file.bytes.size() || size > file.bytes.size() - begin || !file.message.empty()) return true;
  }
  return false;
}

// Strips or tiles: of a block that cannot be read the error says which.
Result<void> read_blocks(TIFF* tiff, const MemoryFile& file, const Sample& sample, TerrainGrid& grid) {
  const bool is_tiled = TIFFIsTiled(tiff) != 0;
  std::uint32_t width = static_cast<std::uint32_t>(grid.columns), height = static_cast<std::uint32_t>(grid.rows);
  std::uint16_t planar = PLANARCONFIG_CONTIG;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &planar);
  if (is_tiled) {
    TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &width);
    TIFFGetField(tiff, TIFFTAG_TILELENGTH, &height);
  } else {
    TIFFGetFieldDefaulted(tiff, TIFFTAG_ROWSPERSTRIP, &height);
    height = std::min(height, static_cast<std::uint32_t>(grid.rows));
  }
  const std::size_t pixel = sample.bits / 8u * (planar == PLANARCONFIG_CONTIG ? sample.per_pixel : 1u);
  const tmsize_t size = is_tiled ? TIFFTileSize(tiff) : TIFFStripSize(tiff);
  if (width == 0 || height == 0 || size <= 0 || static_cast<std::size_t>(size) < pixel * width * height ||
      static_cast<std::size_t>(size) > (std::size_t{1} << 29) ||
      static_cast<std::size_t>(size) / kMostPacking > file.bytes.size())
    return Error{ErrorCode::parse, "TIFF", "The blocks of the GeoTIFF have no sensible size: it is damaged or cut off."};
  std::vector<unsigned char> block(static_cast<std::size_t>(size));
  for (std::size_t top = 0; top < grid.rows; top += height)
    for (std::size_t left = 0; left < grid.columns; left += width) {
      if (is_stop_wished()) return stopped_error();
      const std::uint32_t number =
          is_tiled ? TIFFComputeTile(tiff, static_cast<std::uint32_t>(left), static_cast<std::uint32_t>(top), 0, 0)
                   : TIFFComputeStrip(tiff, static_cast<std::uint32_t>(top), 0);
      const std::size_t rows = std::min<std::size_t>(height, grid.rows - top),
                        columns = std::min<std::size_t>(width, grid.columns - left);
      const tmsize_t got = is_tiled ? TIFFReadEncodedTile(tiff, number, block.data(), size)
                                    : TIFFReadEncodedStrip(tiff, number, block.data(), size);
      if (got < 0 || static_cast<std::size_t>(got) < pixel * width * (rows - 1) + pixel * columns)
        return Error{ErrorCode::parse, "block " + std::to_string(number),
                     "The GeoTIFF cannot be read from here on" + (file.message.empty() ? "" : " (" + file.message + ")") +
                         ": it is cut off or damaged. Fetch it again."};
      for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < columns; ++c)
          grid.values[(top + r) * grid.columns + left + c] = sample.read(block.data() + (r * width + c) * pixel);
    }
  return {};
}

// The tag is a text of few or of many digits, and what it stands for was rounded to the pixels: a few of their last places count
// for nothing.
bool is_nodata(double value, double nodata, bool is_single) {
  const double slack = is_single ? 4.0 * std::numeric_limits<float>::epsilon() : 1e-12;
  return value == nodata || std::abs(value - nodata) <= slack * std::abs(nodata);
}

void drop_nodata(TIFF* tiff, const Sample& sample, TerrainGrid& grid) {
  const bool is_single = sample.format == SAMPLEFORMAT_IEEEFP && sample.bits == 32;
  std::uint32_t count = 0;
  const char* text = nullptr;
  std::optional<double> nodata;
  if (TIFFGetField(tiff, kNodataTag, &count, &text) == 1 && text != nullptr && count > 0 && count < 100) {
    std::string_view word(text, count);
    word = word.substr(0, word.find('\0'));
    while (!word.empty() && word.front() == ' ') word.remove_prefix(1);
    while (!word.empty() && word.back() == ' ') word.remove_suffix(1);
    nodata = parse_number(word);
  }
  for (double& value : grid.values)
    if ((nodata && is_nodata(value, *nodata, is_single)) || !std::isfinite(value))
      value = std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Result<TerrainGrid> read_geotiff(std::string_view bytes) {
  MemoryFile file{bytes, 0, {}};
  const Tiff tiff = open(file);
  if (!tiff)
    return Error{ErrorCode::parse, "TIFF",
                 "The GeoTIFF cannot be opened" + (file.message.empty() ? "" : " (" + file.message + ")") +
                     ": it is cut off or damaged. Fetch it again."};
  std::uint32_t width = 0, height = 0;
  Sample sample;
  TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height);
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_BITSPERSAMPLE, &sample.bits);
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_SAMPLEFORMAT, &sample.format);
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, &sample.per_pixel);
  TerrainGrid grid;
  grid.columns = width;
  grid.rows = height;
  if (width == 0 || height == 0) return Error{ErrorCode::parse, "TIFF", "The picture has no pixels."};
  if (grid.columns * grid.rows > kMostGridCells)
    return Error{ErrorCode::out_of_range, "TIFF",
                 "The picture has more than " + std::to_string(kMostGridCells) + " pixels: cut out the part that you need."};
  if (!sample.is_known() || sample.per_pixel == 0)
    return Error{ErrorCode::parse, "TIFF",
                 "Pixels of this kind are not read: 8 to 64 bit whole numbers and 32 or 64 bit floating ones are."};
  if (is_cut_off(tiff.get(), file))
    return Error{ErrorCode::parse, "byte " + std::to_string(bytes.size()),
                 "The GeoTIFF ends before its last block: the file is cut off. Fetch it again."};
  if (auto placed = place(tiff.get(), grid); !placed) return placed.error();
  grid.crs = crs_of(tiff.get());
  grid.height_unit = height_unit_of(tiff.get());
  // What the file has room for, unpacked a thousand times at most.
  if (grid.columns * grid.rows / kMostPacking > bytes.size())
    return Error{ErrorCode::parse, "TIFF",
                 "The header promises more pixels than the file can hold: the GeoTIFF is cut off or damaged."};
  grid.values.assign(grid.columns * grid.rows, 0);
  if (auto done = read_blocks(tiff.get(), file, sample, grid); !done) return done.error();
  if (sample.per_pixel > 1) grid.notes.push_back("Of " + std::to_string(sample.per_pixel) + " bands the first was read.");
  drop_nodata(tiff.get(), sample, grid);
  summarise(grid);
  return grid;
}

}  // namespace bl::importing
