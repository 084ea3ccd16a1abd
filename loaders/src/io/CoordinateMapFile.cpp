#include "weft/io/CoordinateMapFile.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>

#include "ExrPart.h"
#include "weft/core/AtomicFile.h"

namespace weft {
namespace {

constexpr const char* kWidthAttribute = "weftSampleWidth";
constexpr const char* kHeightAttribute = "weftSampleHeight";
constexpr const char* kNameAttribute = "weftSampleName";
// As many as ZIP packs together, and some more: in 32 bits only these are in memory.
constexpr int kRowsAtOnce = 64;

// Rows of a map as OpenEXR holds them.
class Rows {
 public:
  explicit Rows(int width) : width_(width) {}

  // Room for `count` rows from row `first` of the file, whose first column is `left`.
  Imf::FrameBuffer place(int left, int first, int count) {
    texels_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(count));
    const Imath::Box2i window({left, first}, {left + width_ - 1, first + count - 1});
    const std::size_t rowBytes = sizeof(glm::u32vec2) * static_cast<std::size_t>(width_);
    Imf::FrameBuffer buffer;
    for (const auto& [name, offset] : {std::pair("X", 0), std::pair("Y", 1)})
      buffer.insert(name,
                    Imf::Slice::Make(Imf::UINT, &texels_[0][offset], window, sizeof(glm::u32vec2), rowBytes));
    return buffer;
  }

  std::vector<glm::u32vec2>& texels() { return texels_; }

 private:
  int width_;
  std::vector<glm::u32vec2> texels_;
};

// Larger numbers than a map can hold lie outside of every sample, and stay there.
glm::u16vec2 narrowed(glm::u32vec2 texel) {
  return glm::u16vec2(std::min(texel.x, 0xffffu), std::min(texel.y, 0xffffu));
}

void writeTexels(Imf::OutputFile& file, const CoordinateMap& map) {
  Rows rows(map.width());
  for (int y = 0; y < map.height(); y += kRowsAtOnce) {
    const int count = std::min(kRowsAtOnce, map.height() - y);
    file.setFrameBuffer(rows.place(0, y, count));
    const auto from =
        map.texels().subspan(static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width()));
    for (std::size_t i = 0; i < rows.texels().size(); ++i) rows.texels()[i] = from[i];
    file.writePixels(count);
  }
}

// The texels are appended as they are found, so that memory is taken only for those that are there.
std::vector<glm::u16vec2> readTexels(Imf::InputPart& part, int width) {
  const Imath::Box2i window = part.header().dataWindow();
  std::vector<glm::u16vec2> texels;
  Rows rows(width);
  for (int y = window.min.y; y <= window.max.y; y += kRowsAtOnce) {
    const int count = std::min(kRowsAtOnce, window.max.y - y + 1);
    part.setFrameBuffer(rows.place(window.min.x, y, count));
    part.readPixels(y, y + count - 1);
    std::ranges::transform(rows.texels(), std::back_inserter(texels), narrowed);
  }
  return texels;
}

const Imf::IntAttribute* integerOf(const Imf::Header& header, const char* name) {
  return header.findTypedAttribute<Imf::IntAttribute>(name);
}

bool hasCoordinates(const Imf::Header& header) {
  const auto isCoordinate = [&](const char* name) {
    const Imf::Channel* channel = header.channels().findChannel(name);
    return channel && channel->type == Imf::UINT && channel->xSampling == 1 && channel->ySampling == 1;
  };
  return isCoordinate("X") && isCoordinate("Y");
}

Result<CoordinateMap> readMap(Imf::MultiPartInputFile& file, std::uint64_t fileBytes,
                              const std::string& where) {
  const Imf::Header& header = file.header(0);
  const Imf::IntAttribute* sampleWidth = integerOf(header, kWidthAttribute);
  const Imf::IntAttribute* sampleHeight = integerOf(header, kHeightAttribute);
  if (!sampleWidth || !sampleHeight)
    return fail("not a coordinate map: the OpenEXR file does not say how large the sample is", where);
  WEFT_TRY(const glm::ivec2 size, exrPartSize(header, where));
  if (!hasCoordinates(header)) return fail("a coordinate map has the integer channels X and Y", where);
  WEFT_TRY_VOID(checkExrPart(header, fileBytes, where));
  const auto texels = static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
  WEFT_TRY_VOID(checkExrMemory(texels, fileBytes, where));
  const auto* name = header.findTypedAttribute<Imf::StringAttribute>(kNameAttribute);
  Imf::InputPart part(file, 0);
  return CoordinateMap::create(size.x, size.y, sampleWidth->value(), sampleHeight->value(),
                               readTexels(part, size.x), name ? name->value() : std::string());
}

}  // namespace

Result<void> writeCoordinateMap(const std::filesystem::path& path, const CoordinateMap& map) {
  WEFT_TRY(AtomicFile file, AtomicFile::create(path));
  try {
    Imf::Header header(map.width(), map.height());
    header.compression() = Imf::ZIP_COMPRESSION;
    header.setType(Imf::SCANLINEIMAGE);
    for (const char* channel : {"X", "Y"}) header.channels().insert(channel, Imf::Channel(Imf::UINT));
    header.insert(kWidthAttribute, Imf::IntAttribute(map.sampleWidth()));
    header.insert(kHeightAttribute, Imf::IntAttribute(map.sampleHeight()));
    if (!map.sampleName().empty()) header.insert(kNameAttribute, Imf::StringAttribute(map.sampleName()));
    Imf::OutputFile output(file.temporary().c_str(), header, 0);
    writeTexels(output, map);
  } catch (const std::exception& error) {
    return fail(std::string("the coordinate map cannot be written: ") + error.what(), path.string(),
                "is the disk full?");
  }
  return file.commit();
}

Result<CoordinateMap> readCoordinateMap(const std::filesystem::path& path) {
  const std::string where = path.string();
  WEFT_TRY(const std::uint64_t fileBytes, checkExrFile(path));
  return readingExr(where, [&]() -> Result<CoordinateMap> {
    Imf::MultiPartInputFile file(where.c_str(), 0);
    Result<CoordinateMap> map = readMap(file, fileBytes, where);
    if (!map && map.error().where.empty()) map.error().where = where;
    return map;
  });
}

bool isCoordinateMap(const std::filesystem::path& path) {
  if (!checkExrFile(path)) return false;
  try {
    return integerOf(Imf::MultiPartInputFile(path.c_str(), 0).header(0), kWidthAttribute) != nullptr;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace weft
