#include "ExrPart.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTileDescription.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "ImageLimits.h"
#include "weft/core/FileKind.h"
#include "weft/io/FileBytes.h"

namespace weft {
namespace {

// Deflate packs at most 1032 to 1, and halfs become floats; files up to the free size may be better
// packed by other methods.
constexpr std::uint64_t kMostExpansion = 2 * 1032;

// OpenEXR keeps an attribute, of 14 bytes at least, and a channel, of 18, in up to so many bytes in
// its copies of the headers.
constexpr std::uint64_t kEntryMemory = 2400;
constexpr std::uint64_t kSmallestChannel = 18;
constexpr std::uint64_t kMostHeaderExpansion = 16;

constexpr int kMagicBytes = 4;
constexpr std::uint32_t kMultiPartFlag = 0x1000;
constexpr std::size_t kLongestName = 255;

std::uint32_t readInteger(std::istream& stream) {  // little-endian
  std::array<unsigned char, 4> b{};
  stream.read(reinterpret_cast<char*>(b.data()), 4);
  return b[0] | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 | std::uint32_t{b[3]} << 24;
}

// Up to and without the zero byte; empty at the end of a header.
std::string readName(std::istream& stream) {
  std::string name;
  for (char c = 0; stream.get(c) && c != 0;) {
    name.push_back(c);
    if (name.size() > kLongestName) stream.setstate(std::ios::failbit);
  }
  return name;
}

// Counts attributes and channels of a header on; false where an attribute does not fit into the
// file.
bool attributesFit(std::istream& stream, std::uint64_t fileBytes, std::uint64_t& entries) {
  while (!readName(stream).empty()) {
    const std::string type = readName(stream);
    const std::uint32_t size = readInteger(stream);
    if (!stream || static_cast<std::uint64_t>(stream.tellg()) + size > fileBytes) return false;
    stream.seekg(size, std::ios::cur);
    entries += 1 + (type == "chlist" ? size / kSmallestChannel : 0);
  }
  return static_cast<bool>(stream);
}

// Rows of scan lines that are packed together.
std::uint64_t packedRows(Imf::Compression compression) {
  switch (compression) {
    case Imf::NO_COMPRESSION:
    case Imf::RLE_COMPRESSION:
    case Imf::ZIPS_COMPRESSION:
      return 1;
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
      return 16;
    case Imf::DWAB_COMPRESSION:
      return 256;
    default:
      return 32;
  }
}

std::uint64_t columnsOf(const Imf::Header& header) {
  const Imath::Box2i window = header.dataWindow();
  return static_cast<std::uint64_t>(std::int64_t{window.max.x} - window.min.x + 1);
}

// Pixels that are unpacked together: some rows, or a row of tiles.
std::uint64_t packedPixels(const Imf::Header& header) {
  if (!header.hasTileDescription()) return columnsOf(header) * packedRows(header.compression());
  constexpr std::uint64_t kMost = std::uint64_t{1} << 20;  // no product overflows
  const Imf::TileDescription& tile = header.tileDescription();
  return std::max<std::uint64_t>(columnsOf(header), std::min<std::uint64_t>(tile.xSize, kMost)) *
         std::min<std::uint64_t>(tile.ySize, kMost);
}

Imf::PixelType pixelType(const FloatImage& image) {
  return image.precision() == Precision::Half ? Imf::HALF : Imf::FLOAT;
}

// A slice for every channel of interleaved values; `values` is only written to by a reading part.
template <class T>
Imf::FrameBuffer frameBuffer(const FloatImage& image, const std::vector<std::string>& names, const T* values,
                             Imf::PixelType type, const Imath::Box2i& window) {
  const std::size_t pixelBytes = names.size() * sizeof(T);
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < names.size(); ++c)
    buffer.insert(names[c], Imf::Slice::Make(type, values + c, window, pixelBytes,
                                             pixelBytes * static_cast<std::size_t>(image.width())));
  return buffer;
}

}  // namespace

Result<std::uint64_t> checkExrFile(const std::filesystem::path& path) {
  WEFT_TRY(const std::uint64_t fileBytes, regularFileSize(path));
  WEFT_TRY(const std::vector<std::uint8_t> start, readFileStart(path, kFileKindBytes));
  if (const FileKind kind = fileKind(start); kind != FileKind::Exr)
    return failOtherKind(kind, "an OpenEXR file", path.string());
  std::ifstream stream(path, std::ios::binary);
  stream.seekg(kMagicBytes);
  const bool multiPart = (readInteger(stream) & kMultiPartFlag) != 0;
  const std::uint64_t mostEntries = (kFreeBytes + kMostHeaderExpansion * fileBytes) / kEntryMemory;
  std::uint64_t entries = 0;
  do {
    if (!attributesFit(stream, fileBytes, entries))
      return fail("the OpenEXR header is damaged or the file is truncated", path.string());
  } while (multiPart && entries <= mostEntries && stream.peek() != 0);
  if (entries > mostEntries)
    return fail(fmt::format("more than {} attributes and channels in a file of {} bytes are not supported",
                            mostEntries, fileBytes),
                path.string());
  return fileBytes;
}

Result<glm::ivec2> exrPartSize(const Imf::Header& header, const std::string& where) {
  if (header.hasType() && header.type() != Imf::SCANLINEIMAGE && header.type() != Imf::TILEDIMAGE)
    return fail("deep images are not supported", where);
  const Imath::Box2i window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide)
    return fail(fmt::format("an image of {} x {} pixels is not supported", width, height), where,
                fmt::format("at most {} a side", kLargestSide));
  return glm::ivec2(width, height);
}

Result<ExrPartShape> exrPartShape(const Imf::Header& header, const std::string& where) {
  WEFT_TRY(const glm::ivec2 size, exrPartSize(header, where));
  ExrPartShape shape{size.x, size.y, {}, Precision::Half};
  const Imf::ChannelList& channels = header.channels();
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
    const Imf::Channel& properties = channel.channel();
    if (properties.type == Imf::UINT || properties.xSampling != 1 || properties.ySampling != 1)
      return fail(
          fmt::format("channel '{}' is integer or subsampled, which is not supported", channel.name()),
          where);
    if (properties.type == Imf::FLOAT) shape.precision = Precision::Float;
    shape.channels.emplace_back(channel.name());
  }
  if (shape.channels.empty()) return fail("the image has no channels", where);
  return shape;
}

Result<void> checkExrMemory(std::uint64_t values, std::uint64_t fileBytes, const std::string& where) {
  const std::uint64_t bytes = values * sizeof(float);
  if (bytes <= kFreeBytes || bytes / kMostExpansion <= fileBytes) return {};
  return fail(fmt::format("{} bytes of pixels cannot be in a file of {} bytes", bytes, fileBytes), where,
              "the file is damaged");
}

Result<void> checkExrPart(const Imf::Header& header, std::uint64_t fileBytes, const std::string& where) {
  std::uint64_t channels = 0;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) ++channels;
  return checkExrMemory(packedPixels(header) * channels, fileBytes, where);
}

void proveExrPart(Imf::InputPart& part, const std::vector<std::string>& channels, std::uint64_t values,
                  std::uint64_t fileBytes) {
  if (values * sizeof(float) <= kFreeBytes + kUsualExpansion * fileBytes) return;
  const Imath::Box2i window = part.header().dataWindow();
  std::vector<float> row(columnsOf(part.header()));
  Imf::FrameBuffer buffer;
  for (const std::string& name : channels) {
    const Imf::Channel& channel = part.header().channels()[name.c_str()];
    auto* base = reinterpret_cast<char*>(row.data() - window.min.x / channel.xSampling);
    // Rows at a distance of 0 all come to lie in one.
    buffer.insert(name, Imf::Slice(Imf::FLOAT, base, sizeof(float), 0, channel.xSampling, channel.ySampling));
  }
  part.setFrameBuffer(buffer);
  part.readPixels(window.min.y, window.max.y);
}

Imf::Header exrPartHeader(const FloatImage& image) {
  Imf::Header header(image.width(), image.height());
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const std::string& channel : image.channels())
    header.channels().insert(channel, Imf::Channel(pixelType(image)));
  return header;
}

void readExrPart(Imf::InputPart& part, FloatImage& image, int layer) {
  readExrPart(part, image, layer, image.channels());
}

void readExrPart(Imf::InputPart& part, FloatImage& image, int layer, const std::vector<std::string>& names) {
  const Imath::Box2i window = part.header().dataWindow();
  part.setFrameBuffer(frameBuffer(image, names, image.layerValues(layer).data(), Imf::FLOAT, window));
  part.readPixels(window.min.y, window.max.y);
}

void writeExrPart(Imf::OutputFile& file, const FloatImage& image, int layer) {
  const std::span<const float> values = image.layerValues(layer);
  const Imath::Box2i window = file.header().dataWindow();
  if (image.precision() == Precision::Float) {
    file.setFrameBuffer(frameBuffer(image, image.channels(), values.data(), Imf::FLOAT, window));
    file.writePixels(image.height());
    return;
  }
  const std::vector<half> halfs(values.begin(), values.end());
  file.setFrameBuffer(frameBuffer(image, image.channels(), halfs.data(), Imf::HALF, window));
  file.writePixels(image.height());
}

}  // namespace weft
