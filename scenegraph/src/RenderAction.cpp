#include "weft/scenegraph/RenderAction.h"

#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "FlatScene.h"
#include "FrameBlock.h"
#include "FrameLights.h"
#include "RenderPass.h"
#include "ShadowMaps.h"
#include "View.h"

namespace weft {

namespace {

/// What an action has made in a context.
struct FrameObjects {
  PassBuffers buffers;
  ShadowMaps shadows;
};

}  // namespace

/// Where a frame is drawn, and what of it.
struct RenderAction::Place {
  float aspect;
  Encoding encoding;
  ReflectedPart part;
  ShownValue shown;
  std::function<void()> enter, leave;

  bool showsLight() const { return shown == ShownValue::Light; }

  void addTo(ShaderVariant& variant) const {
    const auto define = [&](const char* name) { variant.defines.emplace_back(name, ""); };
    if (shown == ShownValue::Normal) define("SHOW_NORMAL");
    if (shown == ShownValue::Depth) define("SHOW_DEPTH");
    if (shown == ShownValue::TextureCoordinates) define("SHOW_TEXTURE_COORDINATES");
    if (shown == ShownValue::Albedo) define("SHOW_ALBEDO"), define("ONLY_DIFFUSE");
    if (!showsLight()) return;
    if (part == ReflectedPart::Diffuse) define("ONLY_DIFFUSE");
    if (part == ReflectedPart::Specular) define("ONLY_SPECULAR");
    if (encoding == Encoding::Srgb) define("ENCODE_SRGB");
  }
};

/// Kept for its memory.
struct RenderAction::Frame {
  std::vector<std::uint32_t> visible;
  RenderPass pass;
};

RenderAction::RenderAction() : frame_(std::make_unique<Frame>()) {}
RenderAction::~RenderAction() = default;
RenderAction::RenderAction(RenderAction&&) noexcept = default;
RenderAction& RenderAction::operator=(RenderAction&&) noexcept = default;

Result<void> RenderAction::render(GLContext& context, const Node& root, const Camera& camera,
                                  const RenderTarget& target, const RenderOptions& options) {
  const Place place{static_cast<float>(target.width()) / static_cast<float>(target.height()),
                    Encoding::Linear,
                    options.part,
                    options.shown,
                    [&] { target.bindAndClear(context, options.background); },
                    RenderTarget::unbind};
  return renderTo(place, context, root, camera);
}

Result<void> RenderAction::renderInPlace(GLContext& context, const Node& root, const Camera& camera,
                                         Encoding encoding) {
  std::array<GLfloat, 4> viewport{};
  glGetFloatv(GL_VIEWPORT, viewport.data());
  // a window can have been made that small
  if (viewport[2] == 0.0f || viewport[3] == 0.0f) return {};
  const Place place{viewport[2] / viewport[3], encoding, ReflectedPart::All, ShownValue::Light, [] {}, [] {}};
  return renderTo(place, context, root, camera);
}

Result<void> RenderAction::renderTo(const Place& place, GLContext& context, const Node& root,
                                    const Camera& camera) {
  FlatScene& scene = FlatScene::of(root);
  const auto lock = scene.look();
  context.deleteOrphans();
  if (const Node* undressed = scene.undressed())
    return fail("a geometry has no material", undressed->name(), "put it below a MaterialGroup");
  const View view(camera, place.aspect);
  WEFT_TRY(const FrameLights lights, FrameLights::of(scene, view));

  FrameBlock block;
  block.viewProjection = view.fromPlace;
  block.eye = view.eye;
  block.origin = glm::vec4(view.place, 0.0f);
  lights.fill(block, view);
  auto& [buffers, shadows] = context.objectsOf<FrameObjects>(owner_);
  shadows.update(context, scene, view, lights, shadowMapSize_, buffers, block);

  RenderPass& pass = frame_->pass;
  RenderPass::findVisible(scene, view, view.place, frame_->visible);
  pass.arrange(context, scene, view, PassContent::Colors, frame_->visible);
  buffers.setFrame(block);
  ShaderVariant variant;
  if (place.showsLight()) {
    variant = lights.variant();
    shadows.addTo(variant);
  }
  place.addTo(variant);
  context.setProgramVariant(std::move(variant));
  place.enter();
  const EnvironmentLight* environment = place.showsLight() ? lights.environment : nullptr;
  if (!context.failed()) {
    if (environment) environment->lighting().activate(context);
    shadows.bind();
    const bool hasBackground = environment && environment->showsBackground;
    pass.draw(context, buffers, hasBackground ? &environment->background()->state() : nullptr);
    shadows.unbind();
    if (environment) environment->lighting().deactivate(context);
  }
  place.leave();
  const RenderPass::Count& count = pass.count();
  statistics_ = {.objects = scene.objects().used(),
                 .culled = scene.objects().used() - frame_->visible.size(),
                 .triangles = count.triangles,
                 .drawCalls = count.drawCalls,
                 .draws = count.draws,
                 .stateChanges = count.stateChanges,
                 .lights = lights.placed.size(),
                 .updatedNodes = scene.updatedNodes(),
                 .shadowMapsDrawn = shadows.drawn(),
                 .shadowsLeftOut = shadows.leftOut()};
  return context.takeErrors();
}

void RenderAction::setShadowMapSize(int texels) {
  WEFT_EXPECT(texels > 0, "a shadow map has a positive size");
  shadowMapSize_ = texels;
}

}  // namespace weft
