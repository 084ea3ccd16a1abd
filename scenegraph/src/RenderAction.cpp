#include "weft/scenegraph/RenderAction.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

#include "DrawList.h"
#include "FlatScene.h"
#include "FrameBlock.h"
#include "MeshPool.h"
#include "weft/chunks/GLName.h"
#include "weft/scenegraph/EnvironmentLight.h"
#include "weft/shaders/Bindings.h"

namespace weft {

namespace {

/// The GL buffers of an action, filled anew in each frame.
struct FrameObjects {
  GLBuffer frame;
  GLBuffer models;
  GLBuffer commands;
  GLVertexArray noVertices;
};

/// Where a scene's meshes lie in a context, by their number in the scene.
struct ScenePlaces {
  struct Known {
    std::uint64_t serial = 0;
    const MeshPlace* place = nullptr;
  };
  std::vector<Known> known;
};

/// What glMultiDrawElementsIndirect() reads.
struct DrawCommand {
  std::uint32_t indexCount;
  std::uint32_t instanceCount;
  std::uint32_t firstIndex;
  std::int32_t baseVertex;
  std::uint32_t baseInstance;
};
static_assert(sizeof(DrawCommand) == 20);

/// Draws of one state and one vertex array, made by one call of GL.
struct Batch {
  std::uint32_t material;
  const MeshPage* page;
  GLenum mode;
  bool mirrored;
  std::uint32_t firstCommand;
  std::uint32_t commandCount = 0;

  bool sameCall(const Batch& other) const {
    return material == other.material && page == other.page && mode == other.mode &&
           mirrored == other.mirrored;
  }
};

glm::vec3 unitOrZero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : glm::dvec3(0.0);
}

float inverseSquare(float range) {
  return 1.0f / (range * range);
}

LightBlock blockOf(const PlacedLight& light, const glm::dvec3& eye) {
  const glm::vec4 position(glm::dvec3(light.toWorld[3]) - eye, 0.0f);
  const glm::vec3 backwards = unitOrZero(glm::dvec3(light.toWorld[2]));
  if (const auto* directional = dynamic_cast<const DirectionalLight*>(light.core))
    return {glm::vec4(backwards, 0.0f), glm::vec4(directional->irradiance, 0.0f)};
  if (const auto* point = dynamic_cast<const PointLight*>(light.core))
    return {position, glm::vec4(point->intensity, inverseSquare(point->range))};
  const auto& spot = static_cast<const SpotLight&>(*light.core);
  const float outer = std::cos(spot.outerAngle);
  const float slope = 1.0f / std::max(std::cos(spot.innerAngle) - outer, 1e-3f);
  return {position, glm::vec4(spot.intensity, inverseSquare(spot.range)),
          glm::vec4(-slope * backwards, -slope * outer)};
}

/// What is seen from where. Shaders work around the eye, so that floats suffice wherever in the
/// world it is.
struct View {
  View(const Camera& camera, float aspect)
      : place(camera.position()),
        eye(camera.isOrthographic() ? camera.eye() : glm::dvec4(0, 0, 0, 1)),
        axes(glm::dmat3(camera.view)),
        fromEye(camera.projection(aspect) * glm::dmat4(axes)) {}

  glm::dvec3 place;    ///< of the eye in the world
  glm::vec4 eye;       ///< from there: (0, 0, 0, 1), or the direction of an orthographic view
  glm::dmat3 axes;     ///< from the world's axes to the camera's
  glm::dmat4 fromEye;  ///< from the world's axes around the eye to clip space
};

/// What the shaders of a frame share.
struct FrameNumbers {
  FrameBlock block;
  int directionalLights = 0, placedLights = 0;
  const EnvironmentLight* environment = nullptr;

  ShaderVariant variant(ReflectedPart part) const {
    ShaderVariant variant = environment ? environment->variant() : ShaderVariant();
    variant.defines.emplace_back("DIRECTIONAL_LIGHTS", fmt::to_string(directionalLights));
    variant.defines.emplace_back("PLACED_LIGHTS", fmt::to_string(placedLights));
    if (part == ReflectedPart::Diffuse) variant.defines.emplace_back("ONLY_DIFFUSE", "");
    if (part == ReflectedPart::Specular) variant.defines.emplace_back("ONLY_SPECULAR", "");
    return variant;
  }
};

void setEnvironment(FrameBlock& block, const EnvironmentLight& environment, const glm::dmat4& toWorld) {
  // The columns of a rotation are the rows of its inverse; scale does not move what is infinitely
  // far away.
  for (int i = 0; i < 3; ++i)
    block.environmentRows[static_cast<std::size_t>(i)] = glm::vec4(unitOrZero(glm::dvec3(toWorld[i])), 0.0f);
  block.environmentIntensity = glm::vec4(environment.intensity, environment.scale());
}

Result<FrameNumbers> frameNumbers(const FlatScene& scene, const View& view) {
  FrameNumbers numbers;
  numbers.block.viewProjection = view.fromEye;
  numbers.block.eye = view.eye;
  numbers.block.origin = glm::vec4(view.place, 0.0f);
  std::vector<LightBlock> directional, placed;
  for (const PlacedLight& light : scene.lights().all()) {
    if (!light.core || !scene.shows(light.level, view.place)) continue;
    if (const auto* environment = dynamic_cast<const EnvironmentLight*>(light.core)) {
      if (numbers.environment) return fail("the scene has more than one environment");
      numbers.environment = environment;
      setEnvironment(numbers.block, *environment, light.toWorld);
    } else {
      (dynamic_cast<const DirectionalLight*>(light.core) ? directional : placed)
          .push_back(blockOf(light, view.place));
    }
  }
  const std::size_t count = directional.size() + placed.size();
  if (count > kMaximumLights)
    return fail(fmt::format("the scene has {} lights, at most {} can be drawn", count, kMaximumLights));

  numbers.directionalLights = static_cast<int>(directional.size());
  numbers.placedLights = static_cast<int>(placed.size());
  std::copy(placed.begin(), placed.end(),
            std::copy(directional.begin(), directional.end(), numbers.block.lights.begin()));
  return numbers;
}

/// The place of a mesh of the scene in the buffers of the context.
const MeshPlace& placeOf(GLContext& context, ScenePlaces& places, const UsedMesh& mesh,
                         std::uint32_t number) {
  if (number >= places.known.size()) places.known.resize(number + 1);
  ScenePlaces::Known& known = places.known[number];
  if (known.serial != mesh.serial) known = {mesh.serial, &meshPlace(context, mesh.mesh)};
  return *known.place;
}

ModelRows movedTo(ModelRows model, const glm::vec3& place) {
  for (int row = 0; row < 3; ++row) model.rows[row].w = place[row];
  return model;
}

void fill(GLBuffer& buffer, const void* data, std::size_t bytes) {
  if (!buffer) buffer = createGL<GLBuffer>(glCreateBuffers);
  glNamedBufferData(buffer, static_cast<GLsizeiptr>(bytes), data, GL_STREAM_DRAW);
}

}  // namespace

/// Where a frame is drawn, and what of it.
struct RenderAction::Place {
  float aspect;
  Encoding encoding;
  ReflectedPart part;
  std::function<void()> enter, leave;
};

/// The lists of a frame, kept for their memory.
struct RenderAction::Frame {
  std::vector<std::uint32_t> visible;
  DrawList list;
  std::vector<ModelRows> models;  ///< in the order of drawing
  std::vector<DrawCommand> commands;
  std::vector<Batch> batches;

  void findVisible(const FlatScene& scene, const View& view);
  void sort(GLContext& context, const FlatScene& scene, const View& view);
  void batch(GLContext& context, const FlatScene& scene, const View& view);
  void draw(GLContext& context, const FlatScene& scene, FrameObjects& objects,
            const EnvironmentLight* environment, RenderStatistics& statistics) const;
};

void RenderAction::Frame::findVisible(const FlatScene& scene, const View& view) {
  visible.clear();
  scene.boxes().findInside(Frustum(view.place, view.fromEye), visible);
  std::erase_if(visible, [&](std::uint32_t number) {
    const Level level = scene.objects()[number].level;
    return level.lod != kNone && !scene.shows(level, view.place);
  });
}

void RenderAction::Frame::sort(GLContext& context, const FlatScene& scene, const View& view) {
  auto& places = context.objectsOf<ScenePlaces>(scene.owner());
  const glm::dvec3 forward = -glm::transpose(view.axes)[2];
  list.clear();
  for (const std::uint32_t number : visible) {
    const FlatObject& object = scene.objects()[number];
    const UsedMesh& mesh = scene.meshes()[object.mesh];
    const UsedMaterial& material = scene.materials()[object.material];
    const MeshPlace& place = placeOf(context, places, mesh, object.mesh);
    list.add({.blended = material.blended,
              .program = material.program,
              .material = object.material,
              .kind = static_cast<std::uint32_t>(mesh.mesh->topology) << 1 | (object.mirrored ? 1u : 0u),
              .page = place.page->number,
              .mesh = mesh.uses > 1 ? object.mesh + 1 : 0,
              .depth = static_cast<float>(glm::dot(forward, scene.boxes().center(number) - view.place))},
             number);
  }
  list.sort();
}

void RenderAction::Frame::batch(GLContext& context, const FlatScene& scene, const View& view) {
  auto& places = context.objectsOf<ScenePlaces>(scene.owner());
  models.clear();
  commands.clear();
  batches.clear();
  const MeshPlace* latest = nullptr;
  for (const DrawItem& item : list.items()) {
    const FlatObject& object = scene.objects()[item.object];
    const MeshPlace& place = placeOf(context, places, scene.meshes()[object.mesh], object.mesh);
    const Batch next{object.material, place.page.get(), place.mode, object.mirrored,
                     static_cast<std::uint32_t>(commands.size())};
    const bool sameCall = !batches.empty() && next.sameCall(batches.back());
    if (!sameCall) batches.push_back(next);
    if (sameCall && &place == latest) {
      ++commands.back().instanceCount;
    } else {
      commands.push_back({place.indexCount, 1, place.firstIndex, static_cast<std::int32_t>(place.firstVertex),
                          static_cast<std::uint32_t>(models.size())});
      ++batches.back().commandCount;
    }
    models.push_back(movedTo(object.model, scene.boxes().center(item.object) - view.place));
    latest = &place;
  }
}

namespace {

/// Changes GL to the state of what fills the picture, and draws that.
void drawBackground(GLContext& context, const State& state, const State& active, FrameObjects& objects) {
  state.changeFrom(context, active);
  if (context.failed()) return;
  if (!objects.noVertices) objects.noVertices = createGL<GLVertexArray>(glCreateVertexArrays);
  glBindVertexArray(objects.noVertices);
  glFrontFace(GL_CCW);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace

void RenderAction::Frame::draw(GLContext& context, const FlatScene& scene, FrameObjects& objects,
                               const EnvironmentLight* environment, RenderStatistics& statistics) const {
  const State defaults;
  const State* active = &defaults;
  const State* background =
      environment && environment->showsBackground ? &environment->background()->state() : nullptr;
  const MeshPage* page = nullptr;
  glBindBufferBase(GL_UNIFORM_BUFFER, bindings::frameBinding, objects.frame);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, objects.commands);
  if (environment) environment->lighting().activate(context);
  const auto finishBackground = [&] {
    if (!background) return;
    drawBackground(context, *background, *active, objects);
    active = std::exchange(background, nullptr);
    page = nullptr;
  };
  for (const Batch& each : batches) {
    const UsedMaterial& material = scene.materials()[each.material];
    if (material.blended) finishBackground();  // it shines through
    const State& state = material.material->state();
    if (&state != active) {
      state.changeFrom(context, *active);
      active = &state;
      ++statistics.stateChanges;
    }
    if (context.failed()) break;  // there may be no program
    if (page != each.page) {
      page = each.page;
      glBindVertexArray(page->array);
      glVertexArrayVertexBuffer(page->array, kModelBinding, objects.models, 0, sizeof(ModelRows));
    }
    glFrontFace(each.mirrored ? GL_CW : GL_CCW);
    glMultiDrawElementsIndirect(each.mode, GL_UNSIGNED_INT,
                                reinterpret_cast<const void*>(each.firstCommand * sizeof(DrawCommand)),
                                static_cast<GLsizei>(each.commandCount), 0);
    ++statistics.drawCalls;
  }
  if (!context.failed()) finishBackground();
  active->deactivate(context);
  if (environment) environment->lighting().deactivate(context);
  glFrontFace(GL_CCW);
  glBindVertexArray(0);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
  glBindBufferBase(GL_UNIFORM_BUFFER, bindings::frameBinding, 0);
}

RenderAction::RenderAction() : frame_(std::make_unique<Frame>()) {}
RenderAction::~RenderAction() = default;
RenderAction::RenderAction(RenderAction&&) noexcept = default;
RenderAction& RenderAction::operator=(RenderAction&&) noexcept = default;

Result<void> RenderAction::render(GLContext& context, const Node& root, const Camera& camera,
                                  const RenderTarget& target, const RenderOptions& options) {
  const Place place{static_cast<float>(target.width()) / static_cast<float>(target.height()),
                    Encoding::Linear, options.part, [&] { target.bindAndClear(context, options.background); },
                    RenderTarget::unbind};
  return renderTo(place, context, root, camera);
}

Result<void> RenderAction::renderInPlace(GLContext& context, const Node& root, const Camera& camera,
                                         Encoding encoding) {
  std::array<GLfloat, 4> viewport{};
  glGetFloatv(GL_VIEWPORT, viewport.data());
  // a window can have been made that small
  if (viewport[2] == 0.0f || viewport[3] == 0.0f) return {};
  const Place place{viewport[2] / viewport[3], encoding, ReflectedPart::All, [] {}, [] {}};
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
  WEFT_TRY(const FrameNumbers numbers, frameNumbers(scene, view));

  frame_->findVisible(scene, view);
  frame_->sort(context, scene, view);
  frame_->batch(context, scene, view);
  statistics_ = {.objects = scene.objects().used(),
                 .culled = scene.objects().used() - frame_->visible.size(),
                 .draws = frame_->commands.size(),
                 .lights = static_cast<std::size_t>(numbers.directionalLights + numbers.placedLights),
                 .updatedNodes = scene.updatedNodes()};
  for (const Batch& each : frame_->batches)
    for (const DrawCommand& command :
         std::span(frame_->commands).subspan(each.firstCommand, each.commandCount))
      if (each.mode == GL_TRIANGLES) statistics_.triangles += command.indexCount / 3 * command.instanceCount;

  auto& objects = context.objectsOf<FrameObjects>(owner_);
  fill(objects.frame, &numbers.block, sizeof numbers.block);
  ShaderVariant variant = numbers.variant(place.part);
  if (place.encoding == Encoding::Srgb) variant.defines.emplace_back("ENCODE_SRGB", "");
  context.setProgramVariant(std::move(variant));
  if (!frame_->models.empty()) {
    fill(objects.models, frame_->models.data(), frame_->models.size() * sizeof(ModelRows));
    fill(objects.commands, frame_->commands.data(), frame_->commands.size() * sizeof(DrawCommand));
  }
  place.enter();
  if (!context.failed()) frame_->draw(context, scene, objects, numbers.environment, statistics_);
  place.leave();
  return context.takeErrors();
}

}  // namespace weft
