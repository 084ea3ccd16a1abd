#pragma once

#include <cstdint>
#include <vector>

#include "FlatScene.h"
#include "FrameBlock.h"
#include "FrameLights.h"
#include "RenderPass.h"
#include "View.h"
#include "weft/chunks/GLContext.h"
#include "weft/chunks/GLName.h"
#include "weft/shaders/ShaderVariant.h"

namespace weft {

/// The shadow maps of a renderer in one context: depths as lights see them.
///
/// Parallel light and spots take a layer of an array each, which shows all of the scene that they
/// reach; point lights and wide spots a cube, whose faces have half of the size. A map is drawn
/// anew only where its light, or what it shows, is another than before.
class ShadowMaps {
 public:
  /// Brings the maps of the first kMaximumShadows lights that cast shadows up to date, and writes
  /// into the block how they are looked up. Draws into framebuffers of its own; the current one,
  /// and what else says where to draw, stay. `size`: texels a side of a map.
  void update(GLContext& context, const FlatScene& scene, const View& view, const FrameLights& lights,
              int size, PassBuffers& buffers, FrameBlock& block);

  /// Puts the maps on their units for what is drawn next, and takes them off.
  void bind() const;
  void unbind() const;
  /// What programs are told of the maps.
  void addTo(ShaderVariant& variant) const;

  std::size_t drawn() const { return drawn_; }      ///< maps, or faces, by the latest update()
  std::size_t leftOut() const { return leftOut_; }  ///< lights beyond kMaximumShadows

 private:
  /// What a layer shows, and of which state of the scene.
  struct Shown {
    glm::dvec3 place{0.0};
    glm::dmat4 fromPlace{0.0};
    std::uint64_t objectsChange = 0;
    std::vector<std::uint32_t> casters{};

    bool operator==(const Shown&) const = default;
  };
  /// A texture of depths; a cube has six layers.
  struct Maps {
    GLTexture texture;
    int size = 0;
    std::vector<Shown> shown;  ///< by layer
    std::size_t used = 0;      ///< layers, in this frame

    void reserve(GLenum target, int newSize, std::size_t layers);
  };
  struct Frame;

  void updateFlat(Frame& frame, const PlacedLight& light, FrameBlock& block, LightBlock& lightBlock);
  void updateCube(Frame& frame, const PlacedLight& light, LightBlock& lightBlock);
  void updateLayer(Frame& frame, const View& view, Maps& maps, std::size_t layer);

  RenderPass pass_;
  GLFramebuffer framebuffer_;
  Maps flat_, cubes_;
  std::size_t drawn_ = 0, leftOut_ = 0;
};

}  // namespace weft
