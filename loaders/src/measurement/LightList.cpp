#include "LightList.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "FileCollection.h"
#include "ImageBtfSource.h"
#include "weft/core/Direction.h"
#include "weft/io/FileBytes.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestList = std::size_t{1} << 20;
constexpr int kMostLights = 1000;

struct LitImage {
  std::string file;  ///< as the list writes it, with '/' between its parts
  glm::vec3 light{};
  std::string where;  ///< the list and the line
};

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

// Takes the last word off a text.
std::string_view takeLastWord(std::string_view& text) {
  text = trimmed(text);
  std::size_t start = text.size();
  while (start > 0 && !isBlank(text[start - 1])) --start;
  const std::string_view word = text.substr(start);
  text = trimmed(text.substr(0, start));
  return word;
}

template <class T>
std::optional<T> numberOf(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  T number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return number;
}

// "some image.jpg 0.1 -0.2 0.97": names may contain blanks.
Result<LitImage> parseLine(std::string_view line, std::string where) {
  const auto z = numberOf<double>(takeLastWord(line));
  const auto y = numberOf<double>(takeLastWord(line));
  const auto x = numberOf<double>(takeLastWord(line));
  if (!x || !y || !z || line.empty())
    return fail("an image and the three numbers of its light are expected", std::move(where));
  const double length = std::hypot(*x, *y, *z);
  if (!(length >= 1e-4 && length < 1e30))
    return fail(fmt::format("({}, {}, {}) is not the direction of a light", *x, *y, *z), std::move(where));
  LitImage image{std::string(line), glm::vec3(glm::dvec3(*x, *y, *z) / length), std::move(where)};
  std::ranges::replace(image.file, '\\', '/');
  return image;
}

Result<std::vector<LitImage>> parseList(std::string_view text, const std::string& where) {
  std::vector<LitImage> images;
  std::optional<int> count;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    std::string lineWhere = fmt::format("{}, line {}", where, number);
    if (number == 1) {
      count = numberOf<int>(line);
      if (!count || *count < 1 || *count > kMostLights)
        return fail(fmt::format("the number of lights is expected, 1 to {}", kMostLights),
                    std::move(lineWhere));
    } else if (!line.empty()) {
      WEFT_TRY(LitImage image, parseLine(line, std::move(lineWhere)));
      images.push_back(std::move(image));
    }
  }
  if (!count) return fail("the list of lights is empty", where);
  if (images.size() != static_cast<std::size_t>(*count))
    return fail(fmt::format("line 1 counts {} lights, {} are listed", *count, images.size()), where);
  return images;
}

bool isImageName(std::string name) {
  std::ranges::transform(name, name.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return name.ends_with(".jpg") || name.ends_with(".jpeg") || name.ends_with(".png");
}

// The names of the images in a folder, in order.
std::vector<std::string> imagesIn(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (const fs::directory_iterator end; !error && entry != end; entry.increment(error))
    if (std::string name = entry->path().filename().string(); isImageName(name))
      names.push_back(std::move(name));
  std::ranges::sort(names);
  return names;
}

// Where an image of a list is, relative to the list's folder.
std::optional<std::string> fileOf(const LitImage& image, const fs::path& folder) {
  std::error_code error;
  for (const fs::path& file : {fs::path(image.file), fs::path(image.file).filename()})
    if (fs::is_regular_file(folder / file, error)) return file.lexically_normal().generic_string();
  return std::nullopt;
}

Result<std::vector<std::string>> filesOf(const std::vector<LitImage>& images, const fs::path& folder) {
  std::vector<std::string> files;
  std::map<std::string, const LitImage*> imageOfFile;
  const LitImage* missing = nullptr;
  for (const LitImage& image : images) {
    const auto file = fileOf(image, folder);
    if (!file) {
      missing = missing ? missing : &image;
      continue;
    }
    if (const auto [known, isNew] = imageOfFile.emplace(*file, &image); !isNew)
      return fail(fmt::format("the same image as {}", known->second->where), image.where);
    files.push_back(*file);
  }
  if (!missing) return files;
  if (files.empty()) {
    std::vector<std::string> inOrder = imagesIn(folder);
    // Names of different lengths, "9.jpg" and "10.jpg", may be meant in another order than the alphabet's.
    const bool isOneOrder = std::ranges::all_of(
        inOrder, [&](const std::string& name) { return name.size() == inOrder.front().size(); });
    if (inOrder.size() == images.size() && isOneOrder) return inOrder;
  }
  return fail(fmt::format("there is no image '{}'", missing->file), missing->where,
              "images are looked for beside the list; when none is found by its name, as many images as "
              "lights, with names of one length, are taken in order");
}

// By polar angle, then azimuth, as BtfDescription wants it.
std::vector<std::size_t> orderOfLights(const std::vector<LitImage>& images) {
  std::vector<std::size_t> order(images.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) {
    const glm::dvec2 angles = degreesFromDirection(images[i].light);
    return std::pair(angles.x, angles.y);
  });
  return order;
}

}  // namespace

Result<std::unique_ptr<BtfSource>> openLightList(const fs::path& path, std::string name) {
  WEFT_TRY(const std::vector<std::uint8_t> bytes, readFileBytes(path, kLargestList));
  const std::string text(bytes.begin(), bytes.end());
  WEFT_TRY(const std::vector<LitImage> images, parseList(text, path.string()));
  WEFT_TRY(std::vector<std::string> files, filesOf(images, path.parent_path()));

  BtfDescription description;
  description.views = {glm::vec3(0.0f, 0.0f, 1.0f)};
  description.encoding = Encoding::Srgb;
  description.name = std::move(name);
  std::vector<int> fileOfPair;
  for (const std::size_t i : orderOfLights(images)) {
    description.lights.push_back(images[i].light);
    fileOfPair.push_back(static_cast<int>(i));
  }
  return ImageBtfSource::create(std::move(description), listedFiles(path.parent_path(), std::move(files)),
                                std::move(fileOfPair), path.string());
}

}  // namespace weft
