#pragma once

#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "weft/core/ToneMapping.h"

namespace CLI {
class App;
}

namespace weft {

/// The options of command lines that say how large a picture is, and how it is shown.
struct PictureArguments {
  struct Size {
    int width = 0, height = 0;
  };

  std::vector<std::string> size{"800x600"};
  double exposure = 0.0;  ///< stops
  std::string toneMap;    ///< empty: as the picture asks for it

  void addTo(CLI::App& options);
  /// The size, or what is wrong with the command line. "--size N SCENE" may have taken the scene
  /// along, which then becomes `scene`.
  tl::expected<Size, std::string> parse(std::string& scene) const;
  /// What was asked for, else soft where that suits the picture.
  ToneCurve toneCurve(bool softUnasked) const;
};

}  // namespace weft
