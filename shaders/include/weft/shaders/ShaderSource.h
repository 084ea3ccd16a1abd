#pragma once

#include <compare>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "weft/core/Result.h"
#include "weft/shaders/ShaderDefines.h"

namespace weft {

/// Which GLSL files a program is made of. Files are named as in `shaders/`, whose texts are
/// compiled in.
struct ShaderSource {
  std::string vertex;
  std::string fragment;
  ShaderDefines defines{};  ///< in both stages
  /// `#include "KEY"` takes the file VALUE instead ("model.glsl" -> "rfnl.glsl").
  std::map<std::string, std::string> includeAliases{};
  /// Files found here are taken instead of those compiled in; empty: GLContext::shaderFolder().
  std::filesystem::path overrideFolder{};
  /// Files that are given as text, by name; taken before all others.
  std::map<std::string, std::string> texts{};

  auto operator<=>(const ShaderSource&) const = default;
};

/// The text of one stage with its includes put in, each file once.
struct ShaderText {
  std::string text;
  std::vector<std::string> places;  ///< "FILE:LINE" of every line of the text

  /// A compiler's message about the text with places instead of line numbers: "mesh.vert:12(5):
  /// error". `firstPlace` becomes the first of them.
  std::string withPlaces(std::string_view log, std::string& firstPlace) const;
};

/// Puts together the stage that starts with `file`, one of the source's two. Fails on a missing
/// file or on an include that is not `#include "FILE"`, naming file and line. `#version` must be on
/// a line of its own.
Result<ShaderText> assembleShader(const ShaderSource& source, const std::string& file);

}  // namespace weft
