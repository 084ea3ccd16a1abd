#include "weft/scenegraph/Renderer.h"

#include <fmt/format.h>

#include <cstring>
#include <glm/glm.hpp>
#include <vector>

#include "DrawList.h"
#include "FrameBlock.h"
#include "MeshObjects.h"
#include "weft/chunks/GLName.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/Transform.h"

namespace weft {

namespace {

struct FrameObjects {
  GLBuffer frame;
  GLBuffer objects;
};

/// A node on the way down, with what it has from above.
struct Visit {
  const Node* node;
  glm::mat4 model;
  const Material* material;
};

struct Scene {
  DrawList draws;
  std::vector<LightBlock> lights;
};

glm::vec3 unitOrZero(glm::vec3 v) {
  const float length = glm::length(v);
  return length > 0.0f ? v / length : glm::vec3(0.0f);
}

Result<void> addGeometry(const Visit& visit, const Geometry& geometry, const Camera& camera,
                         DrawList& draws) {
  if (!visit.material)
    return fail("a geometry has no material", visit.node->name(), "put it below a MaterialGroup");
  if (geometry.mesh()->indices.empty()) return {};
  const float depth = -(camera.view * visit.model[3]).z;
  draws.add(geometry, visit.material->state(), visit.model, depth);
  return {};
}

/// Lists what is drawn and what lights it. Without recursion, so that the depth of a graph is no matter.
Result<Scene> collect(const Node& root, const Camera& camera) {
  Scene scene;
  std::vector<Visit> visits{{&root, glm::mat4(1.0f), nullptr}};
  while (!visits.empty()) {
    Visit visit = visits.back();
    visits.pop_back();
    const NodeCore* core = &visit.node->core();
    if (const auto* transform = dynamic_cast<const Transform*>(core)) {
      visit.model = visit.model * transform->matrix;
    } else if (const auto* group = dynamic_cast<const MaterialGroup*>(core)) {
      if (!visit.material) visit.material = group->material.get();
    } else if (const auto* geometry = dynamic_cast<const Geometry*>(core)) {
      WEFT_TRY_VOID(addGeometry(visit, *geometry, camera, scene.draws));
    } else if (const auto* point = dynamic_cast<const PointLight*>(core)) {
      scene.lights.push_back({glm::vec4(glm::vec3(visit.model[3]), 1.0f), glm::vec4(point->intensity, 0.0f)});
    } else if (const auto* directional = dynamic_cast<const DirectionalLight*>(core)) {
      scene.lights.push_back(
          {glm::vec4(unitOrZero(glm::vec3(visit.model[2])), 0.0f), glm::vec4(directional->irradiance, 0.0f)});
    }
    const auto& children = visit.node->children();
    for (auto child = children.rbegin(); child != children.rend(); ++child)
      visits.push_back({child->get(), visit.model, visit.material});
  }
  if (scene.lights.size() > kMaximumLights)
    return fail(
        fmt::format("the scene has {} lights, at most {} can be drawn", scene.lights.size(), kMaximumLights));
  scene.draws.sort();
  return scene;
}

FrameBlock frameBlock(const Scene& scene, const Camera& camera, const RenderTarget& target) {
  FrameBlock block;
  const float aspect = static_cast<float>(target.width()) / static_cast<float>(target.height());
  block.viewProjection = camera.projection(aspect) * camera.view;
  block.eye = glm::vec4(camera.position(), 1.0f);
  block.lightCount.x = static_cast<int>(scene.lights.size());
  std::copy(scene.lights.begin(), scene.lights.end(), block.lights.begin());
  return block;
}

bool mirrors(const glm::mat4& model) {
  return glm::determinant(glm::mat3(model)) < 0.0f;
}

/// The inverse transpose but for a positive factor, which also exists where the model is flattened.
glm::mat3 normalMatrix(const glm::mat4& model) {
  const glm::mat3 m(model);
  const glm::mat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return mirrors(model) ? -cofactors : cofactors;
}

std::size_t objectStride(const GLContext& context) {
  const auto alignment = static_cast<std::size_t>(context.limits().uniformOffsetAlignment);
  return (sizeof(ObjectBlock) + alignment - 1) / alignment * alignment;
}

/// The object blocks of all items, each where a uniform buffer may start.
std::vector<std::byte> objectBlocks(const std::vector<DrawItem>& items, std::size_t stride) {
  std::vector<std::byte> bytes(items.size() * stride);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const ObjectBlock block{items[i].model, glm::mat4(normalMatrix(items[i].model))};
    std::memcpy(bytes.data() + i * stride, &block, sizeof block);
  }
  return bytes;
}

void fill(GLBuffer& buffer, const void* data, std::size_t bytes) {
  if (!buffer) buffer = createGL<GLBuffer>(glCreateBuffers);
  glNamedBufferData(buffer, static_cast<GLsizeiptr>(bytes), data, GL_STREAM_DRAW);
}

void draw(GLContext& context, const std::vector<DrawItem>& items, const FrameObjects& objects) {
  const std::size_t stride = objectStride(context);
  const State defaults;
  const State* active = &defaults;
  glBindBufferBase(GL_UNIFORM_BUFFER, kFrameBinding, objects.frame);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const DrawItem& item = items[i];
    item.state->changeFrom(context, *active);
    active = item.state;
    const MeshObjects& mesh = meshObjects(context, item.geometry->mesh());
    if (context.failed()) break;  // there may be no program
    glBindBufferRange(GL_UNIFORM_BUFFER, kObjectBinding, objects.objects, static_cast<GLintptr>(i * stride),
                      sizeof(ObjectBlock));
    glBindVertexArray(mesh.array);
    glFrontFace(mirrors(item.model) ? GL_CW : GL_CCW);
    glDrawElements(mesh.mode, mesh.indexCount, GL_UNSIGNED_INT, nullptr);
  }
  active->deactivate(context);
  glFrontFace(GL_CCW);
  glBindVertexArray(0);
  glBindBufferBase(GL_UNIFORM_BUFFER, kObjectBinding, 0);
  glBindBufferBase(GL_UNIFORM_BUFFER, kFrameBinding, 0);
}

}  // namespace

Result<void> Renderer::render(GLContext& context, const Node& root, const Camera& camera,
                              const RenderTarget& target, const RenderOptions& options) {
  context.deleteOrphans();
  WEFT_TRY(const Scene scene, collect(root, camera));
  const FrameBlock frame = frameBlock(scene, camera, target);
  const auto blocks = objectBlocks(scene.draws.items(), objectStride(context));
  auto& objects = context.objectsOf<FrameObjects>(owner_);
  fill(objects.frame, &frame, sizeof frame);
  if (!blocks.empty()) fill(objects.objects, blocks.data(), blocks.size());

  target.bindAndClear(context, options.background);
  if (!context.failed()) draw(context, scene.draws.items(), objects);
  RenderTarget::unbind();
  return context.takeErrors();
}

}  // namespace weft
