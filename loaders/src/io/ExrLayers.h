#pragma once

#include <OpenEXR/ImfMultiPartInputFile.h>

#include <string>
#include <vector>

#include "weft/core/Result.h"

namespace weft {

/// Channels of an OpenEXR file that are a picture.
struct ExrLayer {
  enum class Kind { Color, LuminanceChroma, Grey };

  int part = 0;
  Kind kind = Kind::Color;
  /// what stands before the last dot of its channels; may be empty
  std::string layer;
  std::vector<std::string> channels;  ///< R, G, B; or Y; or Y, RY, BY
  std::string name;                   ///< for people: of the layer, or else of its part
};

/// Finds the picture in a file of many parts, layers and passes: R, G and B (or red, green and
/// blue), or else luminance with or without chroma. Depth and other data are none. Of several
/// pictures it is the one without a layer's name, or else the one that is named as renderers name
/// the whole picture (rgba, beauty, Combined); then the others are named in `warnings`. Fails,
/// naming them, where that leaves several, and where there is none.
Result<ExrLayer> findPicture(const Imf::MultiPartInputFile& file, const std::string& where,
                             std::vector<std::string>& warnings);

}  // namespace weft
