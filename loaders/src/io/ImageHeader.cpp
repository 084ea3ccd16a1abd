#include "ImageHeader.h"

#include <fmt/format.h>

#include "ImageLimits.h"

namespace weft {
namespace {

constexpr std::int64_t kMostPixels = std::int64_t{1} << 26;

}  // namespace

Result<void> checkImageSize(std::int64_t width, std::int64_t height, const std::string& where) {
  if (width > 0 && height > 0 && width <= kLargestSide && height <= kLargestSide &&
      width * height <= kMostPixels)
    return {};
  return fail(fmt::format("an image of {} x {} pixels is not supported", width, height), where,
              fmt::format("at most {} a side and {} in all", kLargestSide, kMostPixels));
}

tl::unexpected<Error> imageBeyondFile(std::int64_t width, std::int64_t height, std::size_t fileBytes,
                                      const std::string& where) {
  return fail(fmt::format("an image of {} x {} pixels cannot be in {} bytes", width, height, fileBytes),
              where, "the file is damaged or truncated");
}

}  // namespace weft
