#pragma once

#include <memory>

#include "weft/chunks/Chunk.h"
#include "weft/shaders/ShaderSource.h"

namespace weft {

/// A vertex and a fragment shader, compiled per context at the first activation, once for all
/// chunks of equal source, and anew for another GLContext::programVariant(). Default: no program.
///
/// A program that does not compile is reported to the context at every activation, with file and
/// line, and nothing must be drawn with it. Blocks and samplers name their bindings in GLSL:
/// `layout(binding = N)`.
class ProgramChunk : public Chunk {
 public:
  explicit ProgramChunk(ShaderSource source) : source_(std::move(source)) {}

  Slot kind() const override { return ProgramSlot; }
  void activate(GLContext& context, unsigned slot) const override;
  void changeFrom(GLContext& context, const Chunk& old, unsigned slot) const override;
  void deactivate(GLContext& context, unsigned slot) const override;

 private:
  bool isEqual(const Chunk& other) const override;

  ShaderSource source_;
  std::shared_ptr<const void> owner_ = std::make_shared<char>();
};

/// Compiles the programs of the current context again whose files say something else than before:
/// for shaders that are edited while an application runs, in GLContext::shaderFolder() or
/// ShaderSource::overrideFolder. True where one changed. A program whose new text is in error goes
/// on as it was, and the first such error comes back, at every call until the text is mended.
Result<bool> reloadPrograms(GLContext& context);

}  // namespace weft
