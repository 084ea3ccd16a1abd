#include "LightList.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "FilePath.h"
#include "ImageBtfSource.h"
#include "LightListImages.h"
#include "LightListLines.h"
#include "NearbyFiles.h"
#include "weft/core/Direction.h"
#include "weft/core/FileKind.h"
#include "weft/io/FileBytes.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestList = std::size_t{1} << 20;

using LitImages = std::vector<LitImage>;

std::string_view textOf(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Text in the encoding of an old computer is no kind that is known.
Result<void> checkIsText(const std::vector<std::uint8_t>& bytes, const std::string& where) {
  const FileKind kind = fileKind(bytes);
  if (kind == FileKind::Text || kind == FileKind::Unknown || kind == FileKind::Empty) return {};
  return failOtherKind(kind, "a light list", where);
}

int depthOf(std::string_view path) {
  return static_cast<int>(std::ranges::count(path, '/'));
}

Result<void> warnOfDarkLights(const LitImages& images, std::vector<std::string>& warnings,
                              const std::string& where) {
  std::vector<std::string> dark;
  for (const LitImage& image : images)
    if (image.light.z <= 0.0f) dark.push_back(image.listed);
  if (dark.size() == images.size()) return fail("no light is above the horizon", where);
  if (!dark.empty())
    warnings.push_back("fits give no weight to images with light on or below the horizon: " + firstOf(dark));
  return {};
}

void warnOfPlaces(const LightListLines& list, std::vector<std::string>& warnings) {
  double longest = 0.0;
  for (const ListedLight& light : list.lights) longest = std::max(longest, glm::length(light.vector));
  if (longest > 2.0)
    warnings.push_back(
        fmt::format("the vectors to the lights, up to {:.4g} long, are taken as directions: where "
                    "they are places of lights nearby, the fall-off over the image stays in it",
                    longest));
}

// By polar angle, then azimuth, as BtfDescription wants it.
void sortByAngles(LitImages& images) {
  std::ranges::stable_sort(images, {}, [](const LitImage& image) {
    const glm::dvec2 angles = degreesFromDirection(image.light);
    return std::pair(angles.x, angles.y);
  });
}

Result<std::unique_ptr<BtfSource>> openListed(const LightListLines& list,
                                              std::unique_ptr<FileCollection> files,
                                              const ImageFinder& finder, const std::string& listWhere,
                                              std::string where, std::string name,
                                              const BtfOptions& options) {
  BtfDescription description;
  description.name = std::move(name);
  WEFT_TRY(LitImages images, imagesOfLights(list, finder, options, listWhere, description.warnings));
  warnOfPlaces(list, description.warnings);
  WEFT_TRY_VOID(warnOfDarkLights(images, description.warnings, listWhere));
  sortByAngles(images);
  description.views = {glm::vec3(0.0f, 0.0f, 1.0f)};
  description.encoding = Encoding::Srgb;
  std::vector<int> fileOfPair;
  for (const LitImage& image : images) {
    description.lights.push_back(image.light);
    fileOfPair.push_back(image.file);
  }
  return ImageBtfSource::create(std::move(description), std::move(files), std::move(fileOfPair),
                                std::move(where));
}

}  // namespace

bool isLightList(std::string_view path) {
  return extensionOf(path) == ".lp";
}

Result<std::optional<int>> findLightList(const FileCollection& files, const std::string& where) {
  const auto name = [&](int i) -> const std::string& { return files.names()[static_cast<std::size_t>(i)]; };
  std::vector<int> lists;  // all in as many folders as the first
  for (int i = 0; i < static_cast<int>(files.names().size()); ++i) {
    if (!isLightList(name(i))) continue;
    if (!lists.empty() && depthOf(name(i)) > depthOf(name(lists.front()))) continue;
    if (!lists.empty() && depthOf(name(i)) < depthOf(name(lists.front()))) lists.clear();
    lists.push_back(i);
  }
  if (lists.size() > 1)
    return fail(fmt::format("there is more than one light list: '{}', '{}'", name(lists[0]), name(lists[1])),
                where, "give the one that is meant");
  return lists.empty() ? std::optional<int>() : lists.front();
}

Result<std::unique_ptr<BtfSource>> openLightList(const fs::path& path, std::string name,
                                                 const BtfOptions& options) {
  const std::string where = path.string();
  WEFT_TRY(const std::vector<std::uint8_t> bytes, readFileBytes(path, kLargestList));
  WEFT_TRY_VOID(checkIsText(bytes, where));
  WEFT_TRY(const LightListLines list, parseLightList(textOf(bytes), where));
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::vector<std::string> names = filesNear(folder, list);
  const ImageFinder finder(names);
  return openListed(list, listedFiles(folder, std::move(names)), finder, where, where, std::move(name),
                    options);
}

Result<std::unique_ptr<BtfSource>> openLightList(std::unique_ptr<FileCollection> files, int list,
                                                 std::string where, std::string name,
                                                 const BtfOptions& options) {
  const std::string listName = files->names()[static_cast<std::size_t>(list)];
  const std::string listWhere = where + ": " + listName;
  WEFT_TRY(const std::vector<std::uint8_t> bytes, files->read(list));
  if (bytes.size() > kLargestList)
    return fail(fmt::format("the list has {} bytes, more than the {} allowed", bytes.size(), kLargestList),
                listWhere);
  WEFT_TRY_VOID(checkIsText(bytes, listWhere));
  WEFT_TRY(const LightListLines lines, parseLightList(textOf(bytes), listWhere));
  const ImageFinder finder(namesNear(listName, files->names(), lines));
  return openListed(lines, std::move(files), finder, listWhere, std::move(where), std::move(name), options);
}

}  // namespace weft
