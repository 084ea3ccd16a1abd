#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <memory>

#include "weft/chunks/GLContext.h"
#include "weft/core/Color.h"
#include "weft/core/Result.h"
#include "weft/scenegraph/Camera.h"
#include "weft/scenegraph/Node.h"
#include "weft/scenegraph/RenderTarget.h"

namespace weft {

/// Which part of what surfaces reflect is shown: [Meseth 2004] fig. 6 shows them apart. Diffuse is
/// what the models call diffuse, and all of a polynomial.
enum class ReflectedPart { All, Diffuse, Specular };

/// What a picture shows of what is nearest: its light, or what compositing and denoising need. The
/// latter have alpha 1 where something is.
enum class ShownValue {
  Light,
  Normal,  ///< unit, along the world's axes; with a material's normal texture, towards the eye
  Depth,   ///< in every channel: metres along the direction in which the camera looks
  /// The diffuse part of what is reflected of light from straight above, white as 1; of metals 0.
  Albedo,
  TextureCoordinates,  ///< u and v of the mesh's first set; of a measured material times its scale
};

struct RenderOptions {
  glm::vec4 background{0.0f, 0.0f, 0.0f, 1.0f};  ///< linear RGBA
  ReflectedPart part = ReflectedPart::All;       ///< of the light
  ShownValue shown = ShownValue::Light;
};

/// What one frame did.
struct RenderStatistics {
  /// geometries in the scene, once for each place at which they are shown
  std::size_t objects = 0;
  /// of these, outside of the picture or not at their level of detail
  std::size_t culled = 0;
  std::size_t triangles = 0;     ///< drawn; lines and points are not counted
  std::size_t drawCalls = 0;     ///< of GL, each of which may draw many objects
  std::size_t draws = 0;         ///< within these: meshes, or groups of instances of one
  std::size_t stateChanges = 0;  ///< from one material to another
  std::size_t lights = 0;
  /// Nodes that were looked at again: they changed since the scene was last drawn or picked from,
  /// or something above them did. All of them in the first frame.
  std::size_t updatedNodes = 0;
  /// Shadow maps, or faces of them, that were drawn anew.
  std::size_t shadowMapsDrawn = 0;
  /// Lights that cast no shadow although they are to, because eight others do.
  std::size_t shadowsLeftOut = 0;
};

/// Draws a scene. One may serve many scenes, targets and contexts, one render() at a time; several
/// may draw the same scene at once, each on the thread of its own context.
class RenderAction {
 public:
  RenderAction();
  ~RenderAction();
  RenderAction(RenderAction&&) noexcept;
  RenderAction& operator=(RenderAction&&) noexcept;

  /// Draws everything below `root` as the camera sees it, lit by the lights below `root`, and
  /// leaves GL as it starts up, but for the viewport. Fails on more than 256 lights or one
  /// environment, on a geometry without a material, and on whatever was reported to the context: a
  /// shader that does not compile, an image too large.
  Result<void> render(GLContext& context, const Node& root, const Camera& camera, const RenderTarget& target,
                      const RenderOptions& options = {});

  /// Draws over what is in the current framebuffer, in the current viewport; GL is as it starts up
  /// but for what says where to draw. PassiveWindow::render() sees to that. `encoding`: of the
  /// colours written, Linear or Srgb.
  Result<void> renderInPlace(GLContext& context, const Node& root, const Camera& camera, Encoding encoding);

  /// Texels a side of the shadow maps of lights that cast shadows; 2048 unless set. The cubes of
  /// point lights have half of that.
  void setShadowMapSize(int texels);

  /// Of the latest frame.
  const RenderStatistics& statistics() const { return statistics_; }

 private:
  struct Frame;
  struct Place;

  Result<void> renderTo(const Place& place, GLContext& context, const Node& root, const Camera& camera);

  std::unique_ptr<Frame> frame_;
  int shadowMapSize_ = 2048;
  RenderStatistics statistics_;
  std::shared_ptr<const void> owner_ = std::make_shared<char>();
};

}  // namespace weft
