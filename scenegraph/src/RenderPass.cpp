#include "RenderPass.h"

#include <glm/geometric.hpp>
#include <utility>

#include "weft/chunks/DepthChunk.h"
#include "weft/chunks/ProgramChunk.h"
#include "weft/shaders/Bindings.h"

namespace weft {

namespace {

/// Where a scene's meshes lie in a context, by their number in the scene.
struct ScenePlaces {
  struct Known {
    std::uint64_t serial = 0;
    const MeshPlace* place = nullptr;
  };
  std::vector<Known> known;
};

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

State opaqueDepths() {
  State state;
  state.set(ProgramSlot,
            std::make_shared<ProgramChunk>(ShaderSource{.vertex = "mesh.vert", .fragment = "depth.frag"}));
  state.set(DepthSlot, std::make_shared<DepthChunk>());
  return state;
}

/// Changes GL to the state of what fills the picture, and draws that.
void drawBackground(GLContext& context, const State& state, const State& active, PassBuffers& buffers) {
  state.changeFrom(context, active);
  if (context.failed()) return;
  if (!buffers.noVertices) buffers.noVertices = createGL<GLVertexArray>(glCreateVertexArrays);
  glBindVertexArray(buffers.noVertices);
  glFrontFace(GL_CCW);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace

void PassBuffers::setFrame(const FrameBlock& block) {
  fill(frame, &block, sizeof block);
}

RenderPass::RenderPass() : opaqueDepths_(opaqueDepths()) {}

void RenderPass::findVisible(const FlatScene& scene, const View& view, const glm::dvec3& levelsFrom,
                             std::vector<std::uint32_t>& visible) {
  visible.clear();
  scene.boxes().findInside(Frustum(view.place, view.fromPlace), visible);
  std::erase_if(visible, [&](std::uint32_t number) {
    const Level level = scene.objects()[number].level;
    return level.lod != kNone && !scene.shows(level, levelsFrom);
  });
}

const State& RenderPass::stateOf(const Material& material) const {
  if (content_ == PassContent::Colors) return material.state();
  const State* coverage = material.coverage();
  return coverage ? *coverage : opaqueDepths_;
}

void RenderPass::arrange(GLContext& context, const FlatScene& scene, const View& view, PassContent content,
                         const std::vector<std::uint32_t>& visible) {
  content_ = content;
  count_ = {};
  sort(context, scene, view, visible);
  batch(context, scene, view);
  count_.draws = commands_.size();
  for (const Batch& each : batches_)
    for (std::size_t i = 0; each.mode == GL_TRIANGLES && i < each.commandCount; ++i) {
      const Command& command = commands_[each.firstCommand + i];
      count_.triangles += std::size_t{command.indexCount} / 3 * command.instanceCount;
    }
}

void RenderPass::sort(GLContext& context, const FlatScene& scene, const View& view,
                      const std::vector<std::uint32_t>& visible) {
  auto& places = context.objectsOf<ScenePlaces>(scene.owner());
  const bool colors = content_ == PassContent::Colors;
  list_.clear();
  for (const std::uint32_t number : visible) {
    const FlatObject& object = scene.objects()[number];
    const UsedMesh& mesh = scene.meshes()[object.mesh];
    const UsedMaterial& material = scene.materials()[object.material];
    const MeshPlace& place = placeOf(context, places, mesh, object.mesh);
    const bool alike = !colors && !material.material->coverage();
    list_.add(
        {.blended = colors && material.blended,
         .program = alike ? 0 : material.program,
         .material = alike ? 0 : object.material,
         .kind = static_cast<std::uint32_t>(mesh.mesh->topology) << 1 | (object.mirrored ? 1u : 0u),
         .page = place.page->number,
         .mesh = mesh.uses > 1 ? object.mesh + 1 : 0,
         .depth = static_cast<float>(glm::dot(view.forward, scene.boxes().center(number) - view.place))},
        number);
  }
  list_.sort();
}

void RenderPass::batch(GLContext& context, const FlatScene& scene, const View& view) {
  auto& places = context.objectsOf<ScenePlaces>(scene.owner());
  models_.clear();
  commands_.clear();
  batches_.clear();
  const MeshPlace* latest = nullptr;
  for (const DrawItem& item : list_.items()) {
    const FlatObject& object = scene.objects()[item.object];
    const UsedMaterial& material = scene.materials()[object.material];
    const MeshPlace& place = placeOf(context, places, scene.meshes()[object.mesh], object.mesh);
    const Batch next{&stateOf(*material.material),
                     material.blended,
                     place.page.get(),
                     place.mode,
                     object.mirrored,
                     static_cast<std::uint32_t>(commands_.size())};
    const bool sameCall = !batches_.empty() && next.sameCall(batches_.back());
    if (!sameCall) batches_.push_back(next);
    if (sameCall && &place == latest) {
      ++commands_.back().instanceCount;
    } else {
      commands_.push_back({place.indexCount, 1, place.firstIndex,
                           static_cast<std::int32_t>(place.firstVertex),
                           static_cast<std::uint32_t>(models_.size())});
      ++batches_.back().commandCount;
    }
    models_.push_back(movedTo(object.model, scene.boxes().center(item.object) - view.place));
    latest = &place;
  }
}

void RenderPass::draw(GLContext& context, PassBuffers& buffers, const State* background) {
  if (!models_.empty()) {
    fill(buffers.models, models_.data(), models_.size() * sizeof(ModelRows));
    fill(buffers.commands, commands_.data(), commands_.size() * sizeof(Command));
  }
  const State defaults;
  const State* active = &defaults;
  const MeshPage* page = nullptr;
  glBindBufferBase(GL_UNIFORM_BUFFER, bindings::frameBinding, buffers.frame);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, buffers.commands);
  const auto finishBackground = [&] {
    if (!background) return;
    drawBackground(context, *background, *active, buffers);
    active = std::exchange(background, nullptr);
    page = nullptr;
  };
  for (const Batch& each : batches_) {
    if (each.blended) finishBackground();  // it shines through
    if (each.state != active) {
      each.state->changeFrom(context, *active);
      active = each.state;
      ++count_.stateChanges;
    }
    if (context.failed()) break;  // there may be no program
    if (page != each.page) {
      page = each.page;
      glBindVertexArray(page->array);
      glVertexArrayVertexBuffer(page->array, kModelBinding, buffers.models, 0, sizeof(ModelRows));
    }
    glFrontFace(each.mirrored ? GL_CW : GL_CCW);
    glMultiDrawElementsIndirect(each.mode, GL_UNSIGNED_INT,
                                reinterpret_cast<const void*>(each.firstCommand * sizeof(Command)),
                                static_cast<GLsizei>(each.commandCount), 0);
    ++count_.drawCalls;
  }
  if (!context.failed()) finishBackground();
  active->deactivate(context);
  glFrontFace(GL_CCW);
  glBindVertexArray(0);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
  glBindBufferBase(GL_UNIFORM_BUFFER, bindings::frameBinding, 0);
}

}  // namespace weft
