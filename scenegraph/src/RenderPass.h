#pragma once

#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "DrawList.h"
#include "FlatScene.h"
#include "FrameBlock.h"
#include "MeshPool.h"
#include "View.h"
#include "weft/chunks/GLContext.h"
#include "weft/chunks/GLName.h"
#include "weft/chunks/State.h"

namespace weft {

/// The GL buffers of passes, filled anew by each.
struct PassBuffers {
  GLBuffer frame;
  GLBuffer models;
  GLBuffer commands;
  GLVertexArray noVertices;

  void setFrame(const FrameBlock& block);
};

/// What a pass draws of a scene.
enum class PassContent {
  Colors,  ///< everything in its material
  Depths,  ///< what is opaque in one state, the rest in its Material::coverage()
};

/// Objects of a scene as one view shows them: sorted, batched, drawn. Kept for its memory.
class RenderPass {
 public:
  RenderPass();
  /// The numbers of objects that the view shows, at levels of detail for an eye at `levelsFrom`.
  static void findVisible(const FlatScene& scene, const View& view, const glm::dvec3& levelsFrom,
                          std::vector<std::uint32_t>& visible);

  void arrange(GLContext& context, const FlatScene& scene, const View& view, PassContent content,
               const std::vector<std::uint32_t>& visible);
  /// Draws into the current framebuffer, and leaves GL as it starts up. The block `Frame` and the
  /// program variant are set; `background`, if any, is drawn behind what is opaque.
  void draw(GLContext& context, PassBuffers& buffers, const State* background);

  /// What the latest arrange() and draw() came to.
  struct Count {
    std::size_t triangles = 0, drawCalls = 0, draws = 0, stateChanges = 0;
  };
  const Count& count() const { return count_; }

 private:
  /// What glMultiDrawElementsIndirect() reads.
  struct Command {
    std::uint32_t indexCount;
    std::uint32_t instanceCount;
    std::uint32_t firstIndex;
    std::int32_t baseVertex;
    std::uint32_t baseInstance;
  };
  /// Draws of one state and one vertex array, made by one call of GL.
  struct Batch {
    const State* state;
    bool blended;
    const MeshPage* page;
    GLenum mode;
    bool mirrored;
    std::uint32_t firstCommand;
    std::uint32_t commandCount = 0;

    bool sameCall(const Batch& other) const {
      return state == other.state && page == other.page && mode == other.mode && mirrored == other.mirrored;
    }
  };

  void sort(GLContext& context, const FlatScene& scene, const View& view,
            const std::vector<std::uint32_t>& visible);
  void batch(GLContext& context, const FlatScene& scene, const View& view);
  const State& stateOf(const Material& material) const;

  const State opaqueDepths_;  ///< of everything that covers what is behind it
  PassContent content_ = PassContent::Colors;
  DrawList list_;
  std::vector<ModelRows> models_;  ///< in the order of drawing
  std::vector<Command> commands_;
  std::vector<Batch> batches_;
  Count count_;
};

}  // namespace weft
