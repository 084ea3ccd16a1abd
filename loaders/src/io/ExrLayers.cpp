#include "ExrLayers.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfPartType.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "weft/core/PrintableText.h"

namespace weft {
namespace {

constexpr std::size_t kMostNames = 8;  // in a message

std::string lowered(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

std::string afterLastDot(const std::string& name) {
  return name.substr(name.rfind('.') + 1);
}

std::string beforeLastDot(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == name.npos ? std::string() : name.substr(0, dot);
}

/// "red" as "R". Small letters alone are no colours: they name what IDs are packed into.
std::string roleOf(const std::string& channel) {
  const std::string name = afterLastDot(channel);
  for (const std::string color : {"red", "green", "blue"})
    if (lowered(name) == color) return std::string(1, static_cast<char>(color[0] - 'a' + 'A'));
  return name;
}

/// The channels of a layer by their roles.
using Roles = std::map<std::string, std::string>;

std::vector<std::string> channelsOf(const Roles& roles, std::initializer_list<const char*> names) {
  std::vector<std::string> channels;
  for (const char* name : names)
    if (const auto found = roles.find(name); found != roles.end()) channels.push_back(found->second);
  return channels.size() == names.size() ? channels : std::vector<std::string>();
}

bool isData(const std::string& name) {
  const std::string last = lowered(afterLastDot(name));
  return last == "depth" || last == "z";
}

std::optional<ExrLayer> pictureOf(const Roles& roles, int part, const std::string& layer,
                                  const std::string& name) {
  using Kind = ExrLayer::Kind;
  if (isData(name)) return std::nullopt;
  if (auto colors = channelsOf(roles, {"R", "G", "B"}); !colors.empty())
    return ExrLayer{part, Kind::Color, layer, std::move(colors), name};
  if (auto chroma = channelsOf(roles, {"Y", "RY", "BY"}); !chroma.empty())
    return ExrLayer{part, Kind::LuminanceChroma, layer, std::move(chroma), name};
  // Beside an X, Y is a coordinate.
  if (auto grey = channelsOf(roles, {"Y"}); !grey.empty() && !roles.contains("X"))
    return ExrLayer{part, Kind::Grey, layer, std::move(grey), name};
  return std::nullopt;
}

bool isFlat(const Imf::Header& header) {
  return !header.hasType() || header.type() == Imf::SCANLINEIMAGE || header.type() == Imf::TILEDIMAGE;
}

std::vector<ExrLayer> picturesOf(const Imf::MultiPartInputFile& file) {
  std::vector<ExrLayer> pictures;
  for (int part = 0; part < file.parts(); ++part) {
    const Imf::Header& header = file.header(part);
    if (!isFlat(header)) continue;
    std::map<std::string, Roles> layers;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
      layers[beforeLastDot(channel.name())].emplace(roleOf(channel.name()), channel.name());
    for (const auto& [layer, roles] : layers) {
      const std::string partName = header.hasName() ? header.name() : std::string();
      if (auto picture = pictureOf(roles, part, layer, layer.empty() ? partName : layer))
        pictures.push_back(std::move(*picture));
    }
  }
  return pictures;
}

std::string listOf(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i)
    list += (i > 0 ? ", " : "") + (names[i].empty() ? std::string("the unnamed one") : printable(names[i]));
  if (names.size() > kMostNames) list += fmt::format(" and {} more", names.size() - kMostNames);
  return list;
}

tl::unexpected<Error> noPicture(const Imf::MultiPartInputFile& file, const std::string& where) {
  std::vector<std::string> names;
  bool isDeep = true;
  for (int part = 0; part < file.parts(); ++part) {
    isDeep = isDeep && !isFlat(file.header(part));
    const Imf::ChannelList& channels = file.header(part).channels();
    for (auto channel = channels.begin(); channel != channels.end(); ++channel)
      names.emplace_back(channel.name());
  }
  if (isDeep) return fail("deep images are not supported", where);
  return fail("the file holds no picture (channels R, G, B or Y), but only " + listOf(names), where);
}

bool isWholePicture(const ExrLayer& picture) {
  constexpr std::array names{"rgba", "rgb", "beauty", "combined"};
  return std::ranges::find(names, lowered(afterLastDot(picture.name))) != names.end();
}

/// The only element of which something is true.
template <class Property>
std::optional<std::size_t> onlyOne(const std::vector<ExrLayer>& pictures, const Property& property) {
  const auto found = std::ranges::find_if(pictures, property);
  if (std::ranges::count_if(pictures, property) != 1) return std::nullopt;
  return static_cast<std::size_t>(found - pictures.begin());
}

std::vector<std::string> namesOf(const std::vector<ExrLayer>& pictures) {
  std::vector<std::string> names;
  for (const ExrLayer& picture : pictures) names.push_back(picture.name);
  return names;
}

}  // namespace

Result<ExrLayer> findPicture(const Imf::MultiPartInputFile& file, const std::string& where,
                             std::vector<std::string>& warnings) {
  std::vector<ExrLayer> pictures = picturesOf(file);
  if (pictures.empty()) return noPicture(file, where);
  const auto isGrey = [](const ExrLayer& picture) { return picture.kind == ExrLayer::Kind::Grey; };
  if (!std::ranges::all_of(pictures, isGrey)) std::erase_if(pictures, isGrey);
  const auto isUnnamed = [](const ExrLayer& picture) { return picture.layer.empty(); };
  if (const auto unnamed = onlyOne(pictures, isUnnamed)) return pictures[*unnamed];
  if (pictures.size() == 1) return pictures[0];
  const std::vector<std::string> names = namesOf(pictures);
  const auto whole = onlyOne(pictures, isWholePicture);
  if (!whole)
    return fail(fmt::format("the file holds several pictures: {}", listOf(names)), where,
                "save the one that is meant as a file of its own");
  ExrLayer picture = pictures[*whole];
  pictures.erase(pictures.begin() + static_cast<std::ptrdiff_t>(*whole));
  warnings.push_back(fmt::format("'{}' is taken for the picture, and not {}", printable(picture.name),
                                 listOf(namesOf(pictures))));
  return picture;
}

}  // namespace weft
