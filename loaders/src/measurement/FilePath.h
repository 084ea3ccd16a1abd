#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// "photos/coin.JPG": the parts of a path with '/' between its parts, whatever system wrote it.
std::string_view folderOf(std::string_view path);    ///< "photos"; empty without a folder
std::string_view fileNameOf(std::string_view path);  ///< "coin.JPG"
std::string_view stemOf(
    std::string_view path);  ///< "coin"; an extension begins with a letter: "coin.07" has none
std::string extensionOf(std::string_view path);  ///< ".jpg", in lower case; empty without one

/// Whether the name is that of an image that is read: JPEG or PNG, by its extension.
bool isReadableImage(std::string_view path);
/// Whether the name is that of an image, in any format that measurements are taken in or exported
/// to.
bool isAnyImage(std::string_view path);
/// What systems and viewers leave among the files of people: hidden files, macOS's __MACOSX,
/// thumbnails.
bool isClutter(std::string_view path);

/// The first few of many names, for a message: "a.png, b.png, c.png and 46 more".
std::string firstOf(const std::vector<std::string>& names);

}  // namespace weft
