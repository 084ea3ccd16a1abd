#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "ColorPrimaries.h"
#include "ExrLayers.h"
#include "ExrPart.h"
#include "ImageHeader.h"
#include "weft/io/ExrFile.h"

namespace weft {
namespace {

// A picture may lie in a larger black one; when that is much larger, memory is no longer in
// proportion.
constexpr std::int64_t kMostMargin = 64;
constexpr std::int64_t kFreePixels = std::int64_t{1} << 22;

struct Size {
  std::int64_t width;
  std::int64_t height;
  std::int64_t pixels() const { return width * height; }
};

Size sizeOf(const Imath::Box2i& window) {
  return {std::int64_t{window.max.x} - window.min.x + 1, std::int64_t{window.max.y} - window.min.y + 1};
}

bool isSame(const Imath::Box2i& a, const Imath::Box2i& b) {
  return a.min == b.min && a.max == b.max;
}

Result<void> checkWindows(const Imf::Header& header, const std::string& where,
                          std::vector<std::string>& warnings) {
  const Imath::Box2i data = header.dataWindow(), display = header.displayWindow();
  const Size dataSize = sizeOf(data), displaySize = sizeOf(display);
  WEFT_TRY_VOID(checkImageSize(dataSize.width, dataSize.height, where));
  WEFT_TRY_VOID(checkImageSize(displaySize.width, displaySize.height, where));
  if (!data.intersects(display)) return fail("its pixels lie outside of its display window", where);
  if (displaySize.pixels() > kFreePixels && displaySize.pixels() / kMostMargin > dataSize.pixels())
    return fail(fmt::format("{} x {} pixels alone in a display window of {} x {} are not supported",
                            dataSize.width, dataSize.height, displaySize.width, displaySize.height),
                where);
  if (!display.intersects(data.min) || !display.intersects(data.max))
    warnings.emplace_back("pixels outside of the display window are left out");
  return {};
}

Result<void> checkChannels(const Imf::Header& header, const ExrLayer& picture, const std::string& where) {
  for (const std::string& name : picture.channels) {
    const Imf::Channel& channel = header.channels()[name.c_str()];
    const int sampling = name.ends_with("RY") || name.ends_with("BY") ? 2 : 1;
    if (channel.type == Imf::UINT || channel.xSampling != sampling || channel.ySampling != sampling)
      return fail(fmt::format("channel '{}' is of integers or of an unusual sampling", name), where);
  }
  if (picture.kind == ExrLayer::Kind::LuminanceChroma && picture.part != 0)
    return fail("luminance and chroma are read from a file's first part alone", where);
  if (Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE)
    return fail("the picture is a cube map", where, "exrenvmap -latlong makes an equirectangular picture");
  return {};
}

FloatImage readChannels(Imf::InputPart& part, const ExrLayer& picture) {
  const Size size = sizeOf(part.header().dataWindow());
  const bool isGrey = picture.kind == ExrLayer::Kind::Grey;
  FloatImage image(static_cast<int>(size.width), static_cast<int>(size.height),
                   isGrey ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"});
  readExrPart(part, image, 0, picture.channels);
  return image;
}

/// OpenEXR itself makes RGB of luminance and chroma, in half precision.
FloatImage readChroma(const std::string& path, const ExrLayer& picture) {
  Imf::RgbaInputFile file(path.c_str(), picture.layer, 0);
  const Imath::Box2i window = file.dataWindow();
  const Size size = sizeOf(window);
  const auto width = static_cast<std::size_t>(size.width);
  std::vector<Imf::Rgba> pixels(static_cast<std::size_t>(size.pixels()));
  Imf::Rgba* origin = pixels.data() - window.min.x - window.min.y * static_cast<std::ptrdiff_t>(size.width);
  file.setFrameBuffer(origin, 1, width);
  file.readPixels(window.min.y, window.max.y);
  FloatImage image(static_cast<int>(size.width), static_cast<int>(size.height), {"R", "G", "B"});
  float* to = image.values().data();
  for (const Imf::Rgba& pixel : pixels) {
    *to++ = pixel.r;
    *to++ = pixel.g;
    *to++ = pixel.b;
  }
  return image;
}

/// The pixels of a data window as the display window shows them, which is black where there are
/// none.
FloatImage placed(FloatImage pixels, const Imath::Box2i& data, const Imath::Box2i& display) {
  if (isSame(data, display)) return pixels;
  const Size size = sizeOf(display);
  FloatImage picture(static_cast<int>(size.width), static_cast<int>(size.height), pixels.channels());
  const Imath::Box2i both(
      Imath::V2i(std::max(data.min.x, display.min.x), std::max(data.min.y, display.min.y)),
      Imath::V2i(std::min(data.max.x, display.max.x), std::min(data.max.y, display.max.y)));
  for (int y = both.min.y; y <= both.max.y; ++y)
    for (int x = both.min.x; x <= both.max.x; ++x)
      std::ranges::copy(pixels.texel(x - data.min.x, y - data.min.y),
                        picture.texel(x - display.min.x, y - display.min.y).begin());
  return picture;
}

void convertColors(const Imf::Header& header, FloatImage& image, std::vector<std::string>& warnings) {
  if (!Imf::hasChromaticities(header) || image.channelCount() != 3) return;
  const Imf::Chromaticities& c = Imf::chromaticities(header);
  const auto matrix =
      toRec709({{c.red.x, c.red.y}, {c.green.x, c.green.y}, {c.blue.x, c.blue.y}, {c.white.x, c.white.y}});
  if (matrix)
    transformColors(image, *matrix);
  else
    warnings.emplace_back("its chromaticities are no colours; Rec. 709 is assumed");
}

}  // namespace

Result<FloatImage> readExrPicture(const std::filesystem::path& path, std::vector<std::string>& warnings) {
  const std::string where = path.string();
  WEFT_TRY(const std::uint64_t fileBytes, checkExrFile(path));
  return readingExr(where, [&]() -> Result<FloatImage> {
    Imf::MultiPartInputFile file(path.c_str(), 0);
    WEFT_TRY(const ExrLayer picture, findPicture(file, where, warnings));
    const Imf::Header& header = file.header(picture.part);
    WEFT_TRY_VOID(checkWindows(header, where, warnings));
    WEFT_TRY_VOID(checkChannels(header, picture, where));
    WEFT_TRY_VOID(checkExrPart(header, fileBytes, where));
    Imf::InputPart part(file, picture.part);
    const auto pixels = static_cast<std::uint64_t>(sizeOf(header.dataWindow()).pixels());
    proveExrPart(part, picture.channels, pixels * picture.channels.size(), fileBytes);
    const bool isChroma = picture.kind == ExrLayer::Kind::LuminanceChroma;
    FloatImage image = placed(isChroma ? readChroma(where, picture) : readChannels(part, picture),
                              header.dataWindow(), header.displayWindow());
    convertColors(header, image, warnings);
    return image;
  });
}

}  // namespace weft
