#include "weft/baking/ReferenceRenderer.h"

#include <embree3/rtcore.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "Constants.h"
#include "weft/core/Contract.h"

namespace weft {
namespace {

/// Directions, orthonormal but left-handed where the image is mirrored or seen from behind: go into
/// it by dot products only.
struct TangentFrame {
  glm::vec3 t, b, n;

  glm::vec3 of(glm::vec3 direction) const {
    return {glm::dot(direction, t), glm::dot(direction, b), glm::dot(direction, n)};
  }
};

/// What tangentFrame() of tangent_frame.glsl does. On a back face only the normal turns.
TangentFrame tangentFrame(glm::vec3 normal, glm::vec4 tangent, bool backFace) {
  TangentFrame frame;
  frame.n = normal / std::sqrt(std::max(glm::dot(normal, normal), 1e-30f));
  frame.t = glm::vec3(tangent) - glm::dot(glm::vec3(tangent), frame.n) * frame.n;
  if (!(glm::dot(frame.t, frame.t) > 1e-12f)) {
    const glm::vec3 other = std::abs(frame.n.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    frame.t = other - glm::dot(other, frame.n) * frame.n;
  }
  frame.t /= std::sqrt(std::max(glm::dot(frame.t, frame.t), 1e-30f));
  frame.b = tangent.w * glm::cross(frame.n, frame.t);
  if (backFace) frame.n = -frame.n;
  return frame;
}

bool finite(glm::vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Result<void> check(const ReferenceMesh& mesh) {
  const std::size_t vertices = mesh.positions.size();
  if (mesh.normals.size() != vertices || mesh.tangents.size() != vertices ||
      mesh.texcoords.size() != vertices)
    return fail("the attributes of a mesh differ in number");
  if (mesh.indices.empty() || mesh.indices.size() % 3 != 0)
    return fail("the indices of a mesh are not three a triangle");
  for (const std::uint32_t index : mesh.indices)
    if (index >= vertices) return fail("an index of a mesh points nowhere");
  for (std::size_t i = 0; i < vertices; ++i)
    if (!finite(mesh.positions[i]) || !finite(mesh.normals[i]) || !finite(glm::vec3(mesh.tangents[i])) ||
        !std::isfinite(mesh.tangents[i].w) || !std::isfinite(mesh.texcoords[i].x + mesh.texcoords[i].y))
      return fail("a mesh holds a number that is not finite");
  return {};
}

/// The texel at a texture coordinate of one axis.
int texelAt(float coordinate, int size) {
  const float place = (coordinate - std::floor(coordinate)) * static_cast<float>(size);
  // the fraction of a tiny negative number is 1
  return std::min(static_cast<int>(place), size - 1);
}

/// From a pixel's place (x right, y down, 0..1) to the ray through it.
struct PinholeCamera {
  glm::vec3 eye, forward, right, up;

  PinholeCamera(const ReferenceShot& shot) : eye(shot.eye) {
    const float halfHeight = std::tan(0.5f * shot.verticalFieldOfView);
    forward = glm::normalize(shot.target - shot.eye);
    const glm::vec3 side = glm::normalize(glm::cross(forward, shot.up));
    up = halfHeight * glm::cross(side, forward);
    right = halfHeight * static_cast<float>(shot.width) / static_cast<float>(shot.height) * side;
  }
  glm::vec3 direction(glm::vec2 place) const {
    return glm::normalize(forward + (2.0f * place.x - 1.0f) * right + (1.0f - 2.0f * place.y) * up);
  }
};

}  // namespace

struct ReferenceRenderer::Tracer {
  ReferenceMesh mesh;
  float offset = 0.0f;  ///< by which shadow rays start off the surface
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  explicit Tracer(ReferenceMesh drawn) : mesh(std::move(drawn)) {}
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;
  ~Tracer() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }

  Result<void> build();
  glm::vec4 radiance(glm::vec3 origin, glm::vec3 direction, const ReferenceShot& shot,
                     const ReferenceMaterial& material) const;
  bool shadowed(glm::vec3 origin, glm::vec3 direction, float distance) const;

  template <class T>
  T interpolate(const std::vector<T>& attribute, std::size_t triangle, glm::vec2 uv) const {
    const std::uint32_t* corner = &mesh.indices[3 * triangle];
    return (1.0f - uv.x - uv.y) * attribute[corner[0]] + uv.x * attribute[corner[1]] +
           uv.y * attribute[corner[2]];
  }
};

Result<void> ReferenceRenderer::Tracer::build() {
  glm::vec3 lowest(kInfinity), highest(-kInfinity);
  for (const glm::vec3 position : mesh.positions) {
    lowest = glm::min(lowest, position);
    highest = glm::max(highest, position);
  }
  offset = 1e-4f * glm::length(highest - lowest);

  device = rtcNewDevice(nullptr);
  if (!device) return fail("Embree cannot start");
  scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry triangles = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           3 * sizeof(float), mesh.positions.size());
  void* corners = rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          3 * sizeof(std::uint32_t), mesh.indices.size() / 3);
  if (vertices && corners) {
    float* next = static_cast<float*>(vertices);
    for (const glm::vec3 position : mesh.positions)
      for (int axis = 0; axis < 3; ++axis) *next++ = position[axis];
    std::ranges::copy(mesh.indices, static_cast<std::uint32_t*>(corners));
    rtcCommitGeometry(triangles);
    rtcAttachGeometry(scene, triangles);
    // The tree's shape decides ties between triangles, and so the bytes of the result.
    const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
    rtcCommitScene(scene);
  }
  rtcReleaseGeometry(triangles);
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
    return fail("Embree cannot build the mesh", {}, "is there enough memory?");
  return {};
}

bool ReferenceRenderer::Tracer::shadowed(glm::vec3 origin, glm::vec3 direction, float distance) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray{};
  ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
  ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
  ray.tfar = distance;
  ray.mask = ~0u;
  rtcOccluded1(scene, &context, &ray);
  return ray.tfar < 0.0f;  // Embree's mark of an occluded ray
}

/// What arrives along one ray; w is 1 where it meets the mesh.
glm::vec4 ReferenceRenderer::Tracer::radiance(glm::vec3 origin, glm::vec3 direction,
                                              const ReferenceShot& shot,
                                              const ReferenceMaterial& material) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{};
  query.ray.org_x = origin.x, query.ray.org_y = origin.y, query.ray.org_z = origin.z;
  query.ray.dir_x = direction.x, query.ray.dir_y = direction.y, query.ray.dir_z = direction.z;
  query.ray.tfar = kInfinity;
  query.ray.mask = ~0u;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return glm::vec4(0.0f);

  const std::size_t triangle = query.hit.primID;
  const glm::vec2 uv(query.hit.u, query.hit.v);
  const glm::vec3 position = interpolate(mesh.positions, triangle, uv);
  const glm::vec3 facet = glm::normalize(glm::vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z));
  const bool backFace = glm::dot(facet, direction) > 0.0f;
  glm::vec4 tangent = interpolate(mesh.tangents, triangle, uv);
  tangent.w = mesh.tangents[mesh.indices[3 * triangle]].w;  // a sign, the same at the three corners
  const TangentFrame frame = tangentFrame(interpolate(mesh.normals, triangle, uv), tangent, backFace);
  const glm::vec3 view = frame.of(-direction);
  const glm::vec2 place = material.repetitions * interpolate(mesh.texcoords, triangle, uv);
  const int x = texelAt(place.x, material.width);
  const int y = texelAt(place.y, material.height);
  const glm::vec3 aboveSurface = position + (backFace ? -offset : offset) * facet;

  glm::vec3 sum(0.0f);
  for (const ReferenceLight& light : shot.lights) {
    const bool point = light.kind == ReferenceLight::Kind::Point;
    const glm::vec3 towards = point ? light.place - position : light.place;
    const float squared = std::max(glm::dot(towards, towards), 1e-12f);
    const glm::vec3 toLight = towards / std::sqrt(squared);
    const glm::vec3 l = frame.of(toLight);
    if (!(l.z > 0.0f)) continue;
    if (shot.shadows && shadowed(aboveSurface, toLight, point ? std::sqrt(squared) : kInfinity)) continue;
    sum += light.intensity / (point ? squared : 1.0f) * material.value(x, y, l, view);
  }
  const glm::mat3 axes(frame.t, frame.b, frame.n);
  const glm::vec3 around = material.surroundings ? material.surroundings(x, y, axes, view) : glm::vec3(0.0f);
  return glm::vec4(sum / kPi + around, 1.0f);
}

ReferenceRenderer::ReferenceRenderer(std::unique_ptr<const Tracer> tracer) : tracer_(std::move(tracer)) {}
ReferenceRenderer::ReferenceRenderer(ReferenceRenderer&&) noexcept = default;
ReferenceRenderer& ReferenceRenderer::operator=(ReferenceRenderer&&) noexcept = default;
ReferenceRenderer::~ReferenceRenderer() = default;

Result<ReferenceRenderer> ReferenceRenderer::create(ReferenceMesh mesh) {
  WEFT_TRY_VOID(check(mesh));
  auto tracer = std::make_unique<Tracer>(std::move(mesh));
  WEFT_TRY_VOID(tracer->build());
  return ReferenceRenderer(std::move(tracer));
}

FloatImage ReferenceRenderer::render(const ReferenceShot& shot, const ReferenceMaterial& material) const {
  WEFT_EXPECT(shot.width > 0 && shot.height > 0 && shot.samples > 0, "a picture has pixels and rays");
  WEFT_EXPECT(material.width > 0 && material.height > 0 && (material.value || shot.lights.empty()),
              "a material has texels");
  WEFT_EXPECT(glm::length(glm::cross(shot.target - shot.eye, shot.up)) > 0.0f, "the eye looks somewhere");
  FloatImage image(shot.width, shot.height, {"R", "G", "B", "A"});
  const PinholeCamera camera(shot);
  const auto samples = static_cast<float>(shot.samples);
  const glm::vec2 rays = samples * glm::vec2(shot.width, shot.height);
  tbb::parallel_for(0, shot.height, [&](int row) {
    for (int column = 0; column < shot.width; ++column) {
      glm::vec4 sum(0.0f);
      for (int j = 0; j < shot.samples; ++j)
        for (int i = 0; i < shot.samples; ++i) {
          const glm::vec2 ray(column * shot.samples + i, row * shot.samples + j);
          sum += tracer_->radiance(camera.eye, camera.direction((ray + 0.5f) / rays), shot, material);
        }
      for (int channel = 0; channel < 4; ++channel)
        image.at(column, row, channel) = sum[channel] / (samples * samples);
    }
  });
  return image;
}

ReferenceMesh makeFoldedCloth() {
  constexpr int kCells = 256;
  ReferenceMesh mesh;
  for (int row = 0; row <= kCells; ++row)
    for (int column = 0; column <= kCells; ++column) {
      const glm::vec2 uv = glm::vec2(column, row) / static_cast<float>(kCells);
      const float x = 2.0f * uv.x - 1.0f;
      const float y = 1.0f - 2.0f * uv.y;
      // Two waves that do not repeat within the cloth; z and its slopes along x and y.
      const float amplitude = 0.02f + 0.08f * uv.y;
      const float first = 2.1f * kPi * x + 0.6f * y;
      const float second = 3.7f * kPi * x - 0.9f * y + 1.0f;
      const float wave = std::sin(first) + 0.45f * std::sin(second);
      const float alongX = 2.1f * kPi * std::cos(first) + 0.45f * 3.7f * kPi * std::cos(second);
      const float alongY = 0.6f * std::cos(first) - 0.45f * 0.9f * std::cos(second);
      const glm::vec3 right(1.0f, 0.0f, amplitude * alongX);
      const glm::vec3 up(0.0f, 1.0f, amplitude * alongY - 0.04f * wave);
      mesh.positions.emplace_back(x, y, amplitude * wave);
      mesh.normals.push_back(glm::normalize(glm::cross(right, up)));
      mesh.tangents.emplace_back(glm::normalize(right), 1.0f);
      mesh.texcoords.push_back(uv);
    }
  for (std::uint32_t row = 0; row < kCells; ++row)
    for (std::uint32_t column = 0; column < kCells; ++column) {
      const std::uint32_t upperLeft = row * (kCells + 1) + column;
      const std::uint32_t lowerLeft = upperLeft + kCells + 1;
      for (const std::uint32_t index :
           {upperLeft, lowerLeft, lowerLeft + 1, upperLeft, lowerLeft + 1, upperLeft + 1})
        mesh.indices.push_back(index);
    }
  return mesh;
}

}  // namespace weft
