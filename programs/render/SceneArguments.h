#pragma once

#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "weft/scene_io/SceneSetup.h"

namespace CLI {
class App;
}

namespace weft {

/// The options of command lines that say what scene is shown, and in which light.
struct SceneArguments {
  std::string scene;
  std::string camera;
  std::vector<std::string> lights;
  std::vector<std::string> materials;
  std::vector<std::string> maps;
  float uvScale = 1.0f;
  int views = 3;
  std::string filter = "bilinear";
  std::string tiling = "repeat";
  std::optional<double> time;
  std::string animation;
  std::string environment;
  double environmentRotation = 0.0;
  std::string environmentLobes = "fitted";
  bool shadows = false;

  void addTo(CLI::App& options);
  /// What the words mean, or what is wrong with the command line.
  tl::expected<SceneOptions, std::string> parse() const;
};

}  // namespace weft
