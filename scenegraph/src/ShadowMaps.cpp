#include "ShadowMaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "weft/shaders/Bindings.h"

namespace weft {

namespace {

/// A spot that is wider takes a cube: in one picture its texels would be too different.
constexpr float kWidestSpot = 1.1f;
/// Nothing that is nearer to a lamp than this share of what it reaches casts a shadow.
constexpr double kNearest = 1e-3;

/// Restores what says where to draw, once something else was drawn.
class PlaceGuard {
 public:
  PlaceGuard() {
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer_);
    glGetFloatv(GL_VIEWPORT, viewport_.data());
    glGetBooleanv(GL_DEPTH_WRITEMASK, &depthMask_);
    for (std::size_t i = 0; i < kTests.size(); ++i) {
      tests_[i] = glIsEnabled(kTests[i]);
      glDisable(kTests[i]);
    }
    glDepthMask(GL_TRUE);
  }
  ~PlaceGuard() {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(framebuffer_));
    glViewportIndexedfv(0, viewport_.data());
    glDepthMask(depthMask_);
    for (std::size_t i = 0; i < kTests.size(); ++i)
      if (tests_[i]) glEnable(kTests[i]);
  }
  PlaceGuard(const PlaceGuard&) = delete;
  PlaceGuard& operator=(const PlaceGuard&) = delete;

 private:
  static constexpr std::array<GLenum, 2> kTests{GL_SCISSOR_TEST, GL_STENCIL_TEST};

  GLint framebuffer_ = 0;
  std::array<GLfloat, 4> viewport_{};
  GLboolean depthMask_ = GL_TRUE;
  std::array<GLboolean, kTests.size()> tests_{};
};

/// What a map shows, and how large a texel of it is: in the world, or at distance 1 from a lamp.
struct Seen {
  View view;
  double texel;
};

/// A rotation whose third axis is this one, unit.
glm::dmat3 axesAround(const glm::dvec3& z) {
  const glm::dvec3 x =
      glm::normalize(glm::cross(std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), z));
  return {x, glm::cross(z, x), z};
}

/// All of the scene, as parallel light from there sees it; none where there is nothing.
std::optional<Seen> seenInParallel(const FlatScene& scene, const glm::dvec3& backwards, int size) {
  const glm::dmat3 axes = axesAround(backwards);
  glm::dvec3 middle(0.0), half(0.0);
  for (int i = 0; i < 3; ++i) {
    const auto [low, high] = scene.boxes().along(axes[i]);
    if (!(low <= high)) return std::nullopt;
    middle[i] = 0.5 * (low + high);
    half[i] = (0.5 + 4.0 / size) * (high - low);  // with room for the filter
  }
  const double width = std::max(half.x, half.y);
  // what is flat, too
  half = glm::max(half, glm::dvec3(std::max(1e-3 * std::max(width, half.z), 1e-30)));
  const glm::dmat4 scaled = glm::scale(glm::dmat4(1.0), glm::dvec3(1, 1, -1) / half);
  return Seen{View(axes * middle, scaled * glm::dmat4(glm::transpose(axes))), 2.0 * width / size};
}

/// What is seen from a place in the cone around -Z of these axes.
Seen seenInCone(const glm::dvec3& place, const glm::dmat3& axes, double slope, double reach, int size) {
  return {View(place, glm::perspective(2.0 * std::atan(slope), 1.0, kNearest * reach, reach) *
                          glm::dmat4(glm::transpose(axes))),
          2.0 * slope / size};
}

/// The axes of a face of a cube map: right, up, backwards.
glm::dmat3 axesOfFace(std::size_t face) {
  static constexpr std::array<glm::dvec3, 6> kForward{
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
  static constexpr std::array<glm::dvec3, 6> kUp{
      {{0, -1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0, -1, 0}, {0, -1, 0}}};
  return {glm::cross(kForward[face], kUp[face]), kUp[face], -kForward[face]};
}

bool takesCube(const Light& light) {
  const auto* spot = dynamic_cast<const SpotLight*>(&light);
  return dynamic_cast<const PointLight*>(&light) || (spot && spot->outerAngle > kWidestSpot);
}

/// How far a lamp has to look; 0 where there is nothing.
double reachOf(const FlatScene& scene, const PlacedLight& light) {
  const auto* spot = dynamic_cast<const SpotLight*>(light.core);
  const float range = spot ? spot->range : static_cast<const PointLight&>(*light.core).range;
  const double reach = std::min(double{range}, scene.boxes().reachFrom(glm::dvec3(light.toWorld[3])));
  return std::isfinite(reach) ? reach : 0.0;
}

}  // namespace

/// What all maps of an update() need.
struct ShadowMaps::Frame {
  GLContext& context;
  const FlatScene& scene;
  const View& view;
  PassBuffers& buffers;
  std::optional<PlaceGuard> guard{};  ///< made when the first map is drawn
};

void ShadowMaps::Maps::reserve(GLenum target, int newSize, std::size_t layers) {
  used = 0;
  if (layers == 0 || (size == newSize && shown.size() >= layers)) return;
  GLuint name = 0;
  glCreateTextures(target, 1, &name);
  texture = GLTexture(name);
  size = newSize;
  shown.assign(layers, {});
  glTextureStorage3D(name, 1, GL_DEPTH_COMPONENT32F, size, size, static_cast<GLsizei>(layers));
  glTextureParameteri(name, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTextureParameteri(name, filter, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTextureParameteri(name, wrap, GL_CLAMP_TO_EDGE);
}

void ShadowMaps::update(GLContext& context, const FlatScene& scene, const View& view,
                        const FrameLights& lights, int size, PassBuffers& buffers, FrameBlock& block) {
  drawn_ = leftOut_ = 0;
  std::vector<std::size_t> casting;
  std::size_t cubes = 0;
  for (std::size_t i = 0; i < lights.placed.size(); ++i) {
    const Light& light = *lights.placed[i].core;
    if (!light.castsShadow) continue;
    if (casting.size() == kMaximumShadows) {
      ++leftOut_;
    } else {
      casting.push_back(i);
      cubes += takesCube(light) ? 1u : 0u;
    }
  }
  flat_.reserve(GL_TEXTURE_2D_ARRAY, size, casting.size() - cubes);
  cubes_.reserve(GL_TEXTURE_CUBE_MAP_ARRAY, std::max(size / 2, 1), 6 * cubes);

  Frame frame{context, scene, view, buffers};
  for (const std::size_t i : casting) {
    if (takesCube(*lights.placed[i].core))
      updateCube(frame, lights.placed[i], block.lights[i]);
    else
      updateFlat(frame, lights.placed[i], block, block.lights[i]);
  }
}

void ShadowMaps::updateFlat(Frame& frame, const PlacedLight& light, FrameBlock& block,
                            LightBlock& lightBlock) {
  const glm::dvec3 backwards(light.toWorld[2]);
  if (!(glm::length(backwards) > 0.0)) return;
  const glm::dvec3 axis = glm::normalize(backwards);
  std::optional<Seen> seen;
  if (const auto* spot = dynamic_cast<const SpotLight*>(light.core)) {
    const double reach = reachOf(frame.scene, light);
    // with room for the filter
    const double slope = std::tan(spot->outerAngle) * (1.0 + 8.0 / flat_.size);
    if (reach > 0.0 && slope > 0.0)
      seen = seenInCone(glm::dvec3(light.toWorld[3]), axesAround(axis), slope, reach, flat_.size);
  } else {
    seen = seenInParallel(frame.scene, axis, flat_.size);
  }
  if (!seen) return;
  const std::size_t layer = flat_.used++;
  updateLayer(frame, seen->view, flat_, layer);
  lightBlock.shadow = {layer, seen->texel, 0.0f, 0.0f};
  const glm::dmat4 fromEye = glm::translate(seen->view.fromPlace, frame.view.place - seen->view.place);
  block.shadowMatrices[layer] = glm::translate(glm::dmat4(1.0), glm::dvec3(0.5)) *
                                glm::scale(glm::dmat4(1.0), glm::dvec3(0.5)) * fromEye;
}

void ShadowMaps::updateCube(Frame& frame, const PlacedLight& light, LightBlock& lightBlock) {
  const double far = reachOf(frame.scene, light), near = kNearest * far;
  if (far <= 0.0) return;
  for (std::size_t face = 0; face < 6; ++face)
    updateLayer(frame, seenInCone(glm::dvec3(light.toWorld[3]), axesOfFace(face), 1.0, far, cubes_.size).view,
                cubes_, cubes_.used + face);
  lightBlock.shadow = {cubes_.used / 6, 2.0 / cubes_.size, far / (far - near), far * near / (far - near)};
  cubes_.used += 6;
}

void ShadowMaps::updateLayer(Frame& frame, const View& view, Maps& maps, std::size_t layer) {
  Shown shown{view.place, view.fromPlace, frame.scene.objectsChange()};
  RenderPass::findVisible(frame.scene, view, frame.view.place, shown.casters);
  if (shown == maps.shown[layer]) return;
  if (!frame.guard) frame.guard.emplace();
  if (!framebuffer_) framebuffer_ = createGL<GLFramebuffer>(glCreateFramebuffers);
  glNamedFramebufferTextureLayer(framebuffer_, GL_DEPTH_ATTACHMENT, maps.texture, 0,
                                 static_cast<GLint>(layer));
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, maps.size, maps.size);
  const float farthest = 1.0f;
  glClearNamedFramebufferfv(framebuffer_, GL_DEPTH, 0, &farthest);

  FrameBlock block;
  block.viewProjection = view.fromPlace;
  frame.buffers.setFrame(block);
  frame.context.setProgramVariant({.defines = {{"DEPTH_ONLY", ""}}});
  pass_.arrange(frame.context, frame.scene, view, PassContent::Depths, shown.casters);
  pass_.draw(frame.context, frame.buffers, nullptr);
  if (!frame.context.failed()) maps.shown[layer] = std::move(shown);
  ++drawn_;
}

void ShadowMaps::bind() const {
  if (flat_.used != 0) glBindTextureUnit(bindings::shadowMapsUnit, flat_.texture);
  if (cubes_.used == 0) return;
  glBindTextureUnit(bindings::shadowCubesUnit, cubes_.texture);
  glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
}

void ShadowMaps::unbind() const {
  for (const GLuint unit : {bindings::shadowMapsUnit, bindings::shadowCubesUnit}) glBindTextureUnit(unit, 0);
  glDisable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
}

void ShadowMaps::addTo(ShaderVariant& variant) const {
  if (flat_.used != 0) variant.defines.emplace_back("SHADOW_MAPS", "");
  if (cubes_.used != 0) variant.defines.emplace_back("SHADOW_CUBES", "");
}

}  // namespace weft
