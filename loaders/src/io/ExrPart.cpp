#include "ExrPart.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfPartType.h>
#include <fmt/format.h>

#include <array>
#include <fstream>

namespace weft {
namespace {

constexpr int kLargestSide = 16384;
// Deflate packs at most 1032 to 1; files up to the free size may be better packed by other methods.
constexpr std::uint64_t kMostExpansion = 2048;
constexpr std::uint64_t kFreeBytes = std::uint64_t{64} << 20;

constexpr std::uint32_t kMagic = 20000630;
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

// False where an attribute does not fit into the file.
bool attributesFit(std::istream& stream, std::uint64_t fileBytes) {
  while (!readName(stream).empty()) {
    readName(stream);  // of the type
    const std::uint32_t size = readInteger(stream);
    if (!stream || static_cast<std::uint64_t>(stream.tellg()) + size > fileBytes) return false;
    stream.seekg(size, std::ios::cur);
  }
  return static_cast<bool>(stream);
}

Imf::PixelType pixelType(const FloatImage& image) {
  return image.precision() == Precision::Half ? Imf::HALF : Imf::FLOAT;
}

// A slice for every channel of interleaved values; `values` is only written to by a reading part.
template <class T>
Imf::FrameBuffer frameBuffer(const FloatImage& image, const T* values, Imf::PixelType type,
                             const Imath::Box2i& window) {
  const std::size_t pixelBytes = image.channels().size() * sizeof(T);
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < image.channels().size(); ++c)
    buffer.insert(image.channels()[c],
                  Imf::Slice::Make(type, values + c, window, pixelBytes,
                                   pixelBytes * static_cast<std::size_t>(image.width())));
  return buffer;
}

}  // namespace

Result<std::uint64_t> checkExrFile(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return fail("no such file", path.string());
  const std::uint64_t fileBytes = std::filesystem::file_size(path, error);
  std::ifstream stream(path, std::ios::binary);
  if (error || !stream) return fail("the file cannot be read", path.string(), "check its permissions");
  if (readInteger(stream) != kMagic || !stream) return fail("not an OpenEXR file", path.string());
  const bool multiPart = (readInteger(stream) & kMultiPartFlag) != 0;
  do {
    if (!attributesFit(stream, fileBytes))
      return fail("the OpenEXR header is damaged or the file is truncated", path.string());
  } while (multiPart && stream.peek() != 0);
  return fileBytes;
}

Result<ExrPartShape> exrPartShape(const Imf::Header& header, const std::string& where) {
  if (header.hasType() && header.type() != Imf::SCANLINEIMAGE && header.type() != Imf::TILEDIMAGE)
    return fail("deep images are not supported", where);
  const Imath::Box2i window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide)
    return fail(fmt::format("an image of {} x {} pixels is not supported", width, height), where,
                fmt::format("at most {} a side", kLargestSide));

  ExrPartShape shape{static_cast<int>(width), static_cast<int>(height), {}, Precision::Half};
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

Imf::Header exrPartHeader(const FloatImage& image) {
  Imf::Header header(image.width(), image.height());
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const std::string& channel : image.channels())
    header.channels().insert(channel, Imf::Channel(pixelType(image)));
  return header;
}

void readExrPart(Imf::InputPart& part, FloatImage& image, int layer) {
  const Imath::Box2i window = part.header().dataWindow();
  part.setFrameBuffer(frameBuffer(image, image.layerValues(layer).data(), Imf::FLOAT, window));
  part.readPixels(window.min.y, window.max.y);
}

void writeExrPart(Imf::OutputFile& file, const FloatImage& image, int layer) {
  const std::span<const float> values = image.layerValues(layer);
  const Imath::Box2i window = file.header().dataWindow();
  if (image.precision() == Precision::Float) {
    file.setFrameBuffer(frameBuffer(image, values.data(), Imf::FLOAT, window));
    file.writePixels(image.height());
    return;
  }
  const std::vector<half> halfs(values.begin(), values.end());
  file.setFrameBuffer(frameBuffer(image, halfs.data(), Imf::HALF, window));
  file.writePixels(image.height());
}

}  // namespace weft
