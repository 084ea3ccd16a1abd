#include "LightListImages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <map>
#include <optional>

#include "FilePath.h"

namespace weft {
namespace {

using FileOfLine = std::vector<std::optional<int>>;

constexpr std::optional<int> kNoImage;

Result<FileOfLine> filesByName(const LightListLines& list, const ImageFinder& finder,
                               std::vector<std::string>& warnings) {
  FileOfLine files;
  std::vector<std::string> others;
  for (const ListedLight& light : list.lights) {
    const auto match = finder.find(light.image);
    if (!match) return fail(match.error().what, light.where, match.error().hint);
    files.push_back(*match ? std::optional((*match)->file) : std::nullopt);
    if (*match && (*match)->hasOtherExtension)
      others.push_back(fmt::format("{} for {}", finder.name((*match)->file), fileNameOf(light.image)));
  }
  if (!others.empty())
    warnings.push_back("images are taken whose names differ from the list's in the extension: " +
                       firstOf(others));
  return files;
}

// The images of the first folder that has any, in the order of their names.
std::vector<int> imagesInOrder(const ImageFinder& finder) {
  for (const std::string_view folder : {"", "jpeg-exports", "../jpeg-exports"}) {
    std::vector<int> images;
    for (int i = 0; i < finder.count(); ++i)
      if (isReadableImage(finder.name(i)) && folderOf(finder.name(i)) == folder) images.push_back(i);
    std::ranges::sort(images, {}, [&](int i) { return finder.name(i); });
    if (!images.empty()) return images;
  }
  return {};
}

// "9.jpg" and "10.jpg" may be meant in another order than the alphabet's.
Result<void> checkIsOneOrder(const std::vector<int>& images, const ImageFinder& finder,
                             const std::string& where) {
  for (const int image : images)
    if (finder.name(image).size() != finder.name(images.front()).size())
      return fail(fmt::format("the order of images whose names differ in length is not sure: '{}', '{}'",
                              finder.name(images.front()), finder.name(image)),
                  where, "number them with leading zeros");
  return {};
}

// Says so once where a name means another image than the order.
void warnOfOtherNames(const LightListLines& list, const ImageFinder& finder, const FileOfLine& files,
                      std::vector<std::string>& warnings) {
  for (std::size_t line = 0; line < files.size(); ++line) {
    const std::string& listed = list.lights[line].image;
    const auto named = finder.find(listed);
    if (!named || !*named || !files[line] || (*named)->file == *files[line]) continue;
    warnings.push_back(fmt::format("the order gives '{}' to the line of '{}'; other lines may differ, too",
                                   finder.name(*files[line]), listed));
    return;
  }
}

Result<FileOfLine> filesInOrder(const LightListLines& list, const ImageFinder& finder,
                                const std::string& where, std::vector<std::string>& warnings) {
  for (const ListedLight& light : list.lights)
    if (endsInNumber(light.image))
      return fail("the image's name ends in a number, which may be the first of four", light.where,
                  "images are taken in order only where each line is a name and three numbers");
  const std::vector<int> images = imagesInOrder(finder);
  WEFT_TRY_VOID(checkIsOneOrder(images, finder, where));
  if (images.size() > list.lights.size())
    return fail(fmt::format("{} lights are listed, {} images are there", list.lights.size(), images.size()),
                where, "images can be taken in order where there are as many as lights");
  FileOfLine files(images.begin(), images.end());
  files.resize(list.lights.size());
  warnOfOtherNames(list, finder, files, warnings);
  return files;
}

tl::unexpected<Error> failMissing(const LightListLines& list, const FileOfLine& files) {
  const auto first = std::ranges::find(files, kNoImage) - files.begin();
  const ListedLight& light = list.lights[static_cast<std::size_t>(first)];
  std::string what = fmt::format("there is no image '{}'", light.image);
  if (const auto missing = std::ranges::count(files, kNoImage); missing > 1)
    what += fmt::format(", nor those of {} other lines", missing - 1);
  return fail(what, light.where,
              endsInNumber(light.image)
                  ? "more numbers than three may follow the image, which Weft does not read"
                  : "images are looked for beside the list, by name with any extension; --in-order takes as "
                    "many images as lights in the order of their names");
}

// The lines that count: all, but for one that line 1 does not count.
Result<std::vector<std::size_t>> linesToUse(const LightListLines& list, const FileOfLine& files,
                                            const std::string& where, std::vector<std::string>& warnings) {
  const int listed = static_cast<int>(list.lights.size());
  const std::string counts = fmt::format("line 1 counts {} lights, {} are listed", list.count, listed);
  if (listed == 0 || std::abs(listed - list.count) > 1) return fail(counts, where);
  const bool hasOneMore = listed == list.count + 1;
  const auto missing = std::ranges::count(files, kNoImage);
  if (missing > (hasOneMore ? 1 : 0)) return failMissing(list, files);

  std::vector<std::size_t> lines(list.lights.size());
  for (std::size_t i = 0; i < lines.size(); ++i) lines[i] = i;
  if (hasOneMore) {
    const auto leftOut = missing == 1 ? std::ranges::find(files, kNoImage) - files.begin() : listed - 1;
    lines.erase(lines.begin() + leftOut);
    warnings.push_back(fmt::format("{}: '{}' is left out{}", counts,
                                   list.lights[static_cast<std::size_t>(leftOut)].image,
                                   missing == 1 ? ", which has no image" : ""));
  } else if (listed != list.count) {
    warnings.push_back(counts + ": all of them are taken");
  }
  return lines;
}

}  // namespace

Result<std::vector<LitImage>> imagesOfLights(const LightListLines& list, const ImageFinder& finder,
                                             const BtfOptions& options, const std::string& where,
                                             std::vector<std::string>& warnings) {
  WEFT_TRY(const FileOfLine files, options.imagesInOrder ? filesInOrder(list, finder, where, warnings)
                                                         : filesByName(list, finder, warnings));
  WEFT_TRY(const std::vector<std::size_t> lines, linesToUse(list, files, where, warnings));
  std::vector<LitImage> images;
  std::map<int, const ListedLight*> lightOfFile;
  for (const std::size_t line : lines) {
    const ListedLight& light = list.lights[line];
    if (const auto [known, isNew] = lightOfFile.emplace(*files[line], &light); !isNew)
      return fail(fmt::format("the same image as {}", known->second->where), light.where);
    images.push_back({light.image, glm::vec3(glm::normalize(light.vector)), *files[line]});
  }
  return images;
}

}  // namespace weft
