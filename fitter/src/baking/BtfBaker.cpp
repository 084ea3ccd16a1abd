#include "weft/baking/BtfBaker.h"

#include <embree3/rtcore.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <string>
#include <utility>

#include "Constants.h"
#include "weft/core/Contract.h"
#include "weft/core/Direction.h"

namespace weft {

namespace {

constexpr std::size_t kPacket = 16;
/// cos 85 degrees: lower directions would need a replicated margin of many periods.
constexpr float kLowestZ = 0.0871f;
constexpr std::size_t kMostQuads = 100'000'000;
/// Paths of bounces from the point that a sample sees. Light that arrives by way of other places is
/// noisier than light that comes directly, and most of these paths cost nothing more because they
/// leave the surface.
constexpr int kBranches = 4;
/// A bounce that runs level for longer than this many margins counts as having left the surface.
constexpr int kMostSegments = 256;

struct Hit {
  glm::vec3 position;
  glm::vec3 normal;
};

// --- Random numbers: functions of what they are for, so that no thread can change them ---

std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

float toUnit(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}

std::uint32_t reverseBits(std::uint32_t x) {
  x = (x >> 16) | (x << 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// Where a random permutation of 0..count-1, which `key` decides, takes `index`: a bijection of the
/// next power of two, repeated until it lands within.
std::uint32_t permuted(std::uint32_t index, std::uint32_t count, std::uint64_t key) {
  const std::uint32_t mask = std::bit_ceil(count) - 1;
  const auto odd = static_cast<std::uint32_t>(key) | 1u;
  const auto shift = static_cast<std::uint32_t>(key >> 32);
  do {
    for (int round = 0; round < 3; ++round) {
      index = (index * odd + shift) & mask;
      index ^= index >> 1;
      index ^= index >> 3;
    }
  } while (index >= count);
  return index;
}

/// Point `sample` of a Hammersley set of `count` in the unit square, shifted by a random amount
/// that `key` decides: stratified in both axes for every count. Points of different keys are
/// independent, because each key also puts its set into an order of its own.
glm::vec2 stratifiedPoint(int sample, int count, std::uint64_t key) {
  const std::uint64_t shift = mix(key);
  const std::uint32_t index =
      permuted(static_cast<std::uint32_t>(sample), static_cast<std::uint32_t>(count), mix(shift));
  const float x =
      static_cast<float>(index) / static_cast<float>(count) + toUnit(static_cast<std::uint32_t>(shift));
  const float y = toUnit(reverseBits(index)) + toUnit(static_cast<std::uint32_t>(shift >> 32));
  return {x - std::floor(x), y - std::floor(y)};
}

/// A direction about `normal` with density cosine / pi.
glm::vec3 cosineDirection(glm::vec3 normal, glm::vec2 point) {
  const float radius = std::sqrt(point.x);
  const float angle = 2.0f * kPi * point.y;
  const glm::vec3 side = std::abs(normal.x) > 0.5f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
  const glm::vec3 tangent = glm::normalize(glm::cross(side, normal));
  const glm::vec3 bitangent = glm::cross(normal, tangent);
  return glm::normalize(radius * std::cos(angle) * tangent + radius * std::sin(angle) * bitangent +
                        std::sqrt(std::max(0.0f, 1.0f - point.x)) * normal);
}

}  // namespace

std::vector<glm::vec3> ubo2003Directions() {
  struct Ring {
    int theta;
    int count;
  };
  constexpr std::array<Ring, 6> kRings{{{0, 1}, {15, 6}, {30, 12}, {45, 18}, {60, 20}, {75, 24}}};
  std::vector<glm::vec3> directions;
  for (const Ring ring : kRings)
    for (int i = 0; i < ring.count; ++i)
      directions.push_back(directionFromDegrees(ring.theta, i * 360.0 / ring.count));
  return directions;
}

Result<void> BakeOptions::validate() const {
  if (width < 1 || height < 1 || width > 1024 || height > 1024)
    return fail(
        "a size of " + std::to_string(width) + " x " + std::to_string(height) + " texels is out of range", {},
        "1 to 1024");
  if (samples < 1 || samples > 4096)
    return fail(std::to_string(samples) + " samples are out of range", {}, "1 to 4096");
  if (bounces < 0 || bounces > 64)
    return fail(std::to_string(bounces) + " bounces are out of range", {}, "0 to 64");
  if (views.empty() || lights.empty()) return fail("there are no views or no lights to bake");
  const auto tooLow = [](glm::vec3 d) {
    return !(d.z >= kLowestZ) || std::abs(glm::length(d) - 1.0f) > 1e-4f;
  };
  if (std::any_of(views.begin(), views.end(), tooLow) || std::any_of(lights.begin(), lights.end(), tooLow))
    return fail("a direction is not a unit vector at most 85 degrees from the normal");
  return {};
}

/// The surface in Embree, replicated around one period as far as the lowest view or light can
/// reach, and what a path needs to know of it.
struct BtfBaker::Tracer {
  HeightField field;
  BakeOptions options;
  float top = 0.0f;
  float margin = 0.0f;  ///< by which the replicated surface exceeds one period on every side
  float offset = 0.0f;  ///< by which rays start off the surface
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Tracer(HeightField bakedField, BakeOptions bakeOptions)
      : field(std::move(bakedField)), options(std::move(bakeOptions)) {}
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;
  ~Tracer() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }

  Result<void> build();
  void fillMesh(int marginSamples, float* vertices, std::uint32_t* quads) const;

  glm::vec2 period() const {
    return {field.spacing * static_cast<float>(field.columns),
            field.spacing * static_cast<float>(field.rows)};
  }
  void wrapIntoPeriod(glm::vec3& position) const;
  const HeightField::Sample& sampleAt(glm::vec3 position) const;

  bool intersect(glm::vec3 origin, glm::vec3 direction, float length, Hit& hit) const;
  bool intersectPeriodic(glm::vec3 origin, glm::vec3 direction, Hit& hit) const;
  glm::vec3 texelPoint(int column, int row, glm::vec2 within) const;
  glm::vec3 reflectance(const HeightField::Sample& sample, glm::vec3 normal, glm::vec3 view,
                        glm::vec3 light) const;
  void addLights(const Hit& hit, glm::vec3 view, glm::vec3 throughput, std::span<glm::vec3> sums) const;
  void addSample(glm::vec3 point, glm::vec3 view, int sample, std::uint64_t key,
                 std::span<glm::vec3> sums) const;
  void tracePath(Hit hit, glm::vec3 towardsEye, int path, std::uint64_t key, std::span<glm::vec3> sums) const;
  void bakeTexel(int view, int column, int row, std::span<glm::vec3> sums) const;
};

Result<void> BtfBaker::Tracer::build() {
  top = field.highest();
  const float bottom = field.lowest();
  float lowestZ = 1.0f;
  for (const glm::vec3 d : options.views) lowestZ = std::min(lowestZ, d.z);
  for (const glm::vec3 d : options.lights) lowestZ = std::min(lowestZ, d.z);
  const float tangent = std::sqrt(std::max(0.0f, 1.0f - lowestZ * lowestZ)) / lowestZ;
  // A view ray runs from the top to the plane and on to the bottom, and the plane may lie outside
  // of both.
  const float range = std::max(top, 0.0f) - std::min(bottom, 0.0f);
  const float reach = std::ceil(range * tangent / field.spacing) + 2.0f;
  const double quadCount = (static_cast<double>(field.columns) + 2.0 * static_cast<double>(reach)) *
                           (static_cast<double>(field.rows) + 2.0 * static_cast<double>(reach));
  if (!(quadCount <= static_cast<double>(kMostQuads)))
    return fail("the height field is too high or too fine for its period", {}, "bake it smaller or flatter");
  const int marginSamples = static_cast<int>(reach);
  margin = reach * field.spacing;
  offset = 1e-3f * field.spacing;

  device = rtcNewDevice(nullptr);
  if (!device) return fail("Embree cannot start");
  scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
  const auto across = static_cast<std::size_t>(field.columns + 2 * marginSamples);
  const auto down = static_cast<std::size_t>(field.rows + 2 * marginSamples);
  void* vertices = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           3 * sizeof(float), (across + 1) * (down + 1));
  void* quads = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4,
                                        4 * sizeof(std::uint32_t), across * down);
  if (vertices && quads) {
    fillMesh(marginSamples, static_cast<float*>(vertices), static_cast<std::uint32_t*>(quads));
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene, mesh);
    // The tree's shape decides ties between facets, and so the bytes of the result. (Embree's own
    // option "threads=1" would slow everything else in the process, too.)
    const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
    rtcCommitScene(scene);
  }
  rtcReleaseGeometry(mesh);
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
    return fail("Embree cannot build the surface", {}, "is there enough memory?");
  return {};
}

void BtfBaker::Tracer::fillMesh(int marginSamples, float* vertices, std::uint32_t* quads) const {
  const int across = field.columns + 2 * marginSamples;
  const int down = field.rows + 2 * marginSamples;
  for (int j = 0; j <= down; ++j)
    for (int i = 0; i <= across; ++i) {
      const int column = i - marginSamples;
      const int row = j - marginSamples;
      *vertices++ = (static_cast<float>(column) + 0.5f) * field.spacing;
      *vertices++ = -(static_cast<float>(row) + 0.5f) * field.spacing;
      *vertices++ = field.atPeriodic(column, row).height;
    }
  const auto stride = static_cast<std::uint32_t>(across + 1);
  for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(down); ++j)
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(across); ++i) {
      const std::uint32_t corner = j * stride + i;
      *quads++ = corner;
      *quads++ = corner + stride;
      *quads++ = corner + stride + 1;
      *quads++ = corner + 1;
    }
}

void BtfBaker::Tracer::wrapIntoPeriod(glm::vec3& position) const {
  const glm::vec2 size = period();
  position.x -= std::floor(position.x / size.x) * size.x;
  position.y -= std::ceil(position.y / size.y) * size.y;  // one period is -size.y < y <= 0
}

const HeightField::Sample& BtfBaker::Tracer::sampleAt(glm::vec3 position) const {
  return field.atPeriodic(static_cast<int>(std::floor(position.x / field.spacing)),
                          static_cast<int>(std::floor(-position.y / field.spacing)));
}

bool BtfBaker::Tracer::intersect(glm::vec3 origin, glm::vec3 direction, float length, Hit& hit) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{};
  query.ray.org_x = origin.x;
  query.ray.org_y = origin.y;
  query.ray.org_z = origin.z;
  query.ray.dir_x = direction.x;
  query.ray.dir_y = direction.y;
  query.ray.dir_z = direction.z;
  query.ray.tfar = length;
  query.ray.mask = ~0u;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit.position = origin + query.ray.tfar * direction;
  wrapIntoPeriod(hit.position);
  hit.normal = glm::normalize(glm::vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z));
  if (hit.normal.z < 0.0f) hit.normal = -hit.normal;
  return true;
}

/// For rays of any slope from within the period: margin by margin, starting again inside the
/// period.
bool BtfBaker::Tracer::intersectPeriodic(glm::vec3 origin, glm::vec3 direction, Hit& hit) const {
  const float level = glm::length(glm::vec2(direction.x, direction.y));
  const float segment = level > 0.0f ? margin / level : kInfinity;
  for (int i = 0; i < kMostSegments; ++i) {
    const float exit = direction.z > 0.0f ? (top - origin.z) / direction.z : kInfinity;
    if (exit <= 0.0f) return false;
    if (intersect(origin, direction, std::min(segment, exit), hit)) return true;
    if (exit <= segment) return false;
    origin += segment * direction;
    wrapIntoPeriod(origin);
  }
  return false;
}

glm::vec3 BtfBaker::Tracer::texelPoint(int column, int row, glm::vec2 within) const {
  const glm::vec2 size = period();
  return {(static_cast<float>(column) + within.x) * size.x / static_cast<float>(options.width),
          -(static_cast<float>(row) + within.y) * size.y / static_cast<float>(options.height), 0.0f};
}

/// pi times the BRDF: Lambert plus GGX with the height-correlated Smith term (Heitz 2014) and no
/// Fresnel factor, which is reciprocal and never reflects more than albedo + specular.
glm::vec3 BtfBaker::Tracer::reflectance(const HeightField::Sample& sample, glm::vec3 normal, glm::vec3 view,
                                        glm::vec3 light) const {
  if (sample.specular <= 0.0f) return sample.albedo;
  const float squared = sample.roughness * sample.roughness;
  const float nv = std::max(glm::dot(normal, view), 1e-4f);
  const float nl = std::max(glm::dot(normal, light), 1e-4f);
  const float nh = std::min(glm::dot(normal, glm::normalize(view + light)), 1.0f);
  const float denominator = nh * nh * (squared - 1.0f) + 1.0f;
  const float masking = 0.5f / (nl * std::sqrt(squared + (1.0f - squared) * nv * nv) +
                                nv * std::sqrt(squared + (1.0f - squared) * nl * nl));
  return sample.albedo + sample.specular * squared / (denominator * denominator) * masking;
}

/// Adds what a surface point sends towards `view` directly from each light that it sees.
void BtfBaker::Tracer::addLights(const Hit& hit, glm::vec3 view, glm::vec3 throughput,
                                 std::span<glm::vec3> sums) const {
  const HeightField::Sample& sample = sampleAt(hit.position);
  const glm::vec3 origin = hit.position + offset * hit.normal;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  // a third less time than COHERENT: measured
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  const std::size_t lights = options.lights.size();
  for (std::size_t next = 0; next < lights;) {
    RTCRay16 rays{};
    alignas(64) std::array<int, kPacket> valid{};
    std::array<std::size_t, kPacket> light{};
    std::size_t count = 0;
    for (; next < lights && count < kPacket; ++next) {
      const glm::vec3 direction = options.lights[next];
      if (glm::dot(hit.normal, direction) <= 0.0f) continue;
      valid[count] = -1;
      light[count] = next;
      rays.org_x[count] = origin.x;
      rays.org_y[count] = origin.y;
      rays.org_z[count] = origin.z;
      rays.dir_x[count] = direction.x;
      rays.dir_y[count] = direction.y;
      rays.dir_z[count] = direction.z;
      rays.tfar[count] = kInfinity;
      rays.mask[count] = ~0u;
      ++count;
    }
    if (count == 0) break;
    rtcOccluded16(valid.data(), scene, &context, &rays);
    for (std::size_t i = 0; i < count; ++i) {
      if (rays.tfar[i] < 0.0f) continue;  // Embree's mark of an occluded ray
      const glm::vec3 direction = options.lights[light[i]];
      sums[light[i]] +=
          throughput * reflectance(sample, hit.normal, view, direction) * glm::dot(hit.normal, direction);
    }
  }
}

/// Everything that the surface sends towards the eye through one point of the plane: light that
/// comes directly, and light along kBranches paths of bounces.
void BtfBaker::Tracer::addSample(glm::vec3 point, glm::vec3 view, int sample, std::uint64_t key,
                                 std::span<glm::vec3> sums) const {
  const float above = std::max(top, 0.0f) + offset;
  Hit hit;
  if (!intersect(point + above / view.z * view, -view, kInfinity, hit)) return;
  addLights(hit, view, glm::vec3(1.0f), sums);
  if (options.bounces == 0) return;
  for (int branch = 0; branch < kBranches; ++branch)
    tracePath(hit, view, sample * kBranches + branch, key, sums);
}

void BtfBaker::Tracer::tracePath(Hit hit, glm::vec3 towardsEye, int path, std::uint64_t key,
                                 std::span<glm::vec3> sums) const {
  glm::vec3 throughput(1.0f / static_cast<float>(kBranches));
  for (int bounce = 1; bounce <= options.bounces; ++bounce) {
    const glm::vec2 random =
        stratifiedPoint(path, options.samples * kBranches, key + static_cast<std::uint64_t>(bounce));
    const glm::vec3 direction = cosineDirection(hit.normal, random);
    throughput *= reflectance(sampleAt(hit.position), hit.normal, towardsEye, direction);
    if (!intersectPeriodic(hit.position + offset * hit.normal, direction, hit)) return;
    towardsEye = -direction;
    addLights(hit, towardsEye, throughput, sums);
  }
}

void BtfBaker::Tracer::bakeTexel(int view, int column, int row, std::span<glm::vec3> sums) const {
  std::fill(sums.begin(), sums.end(), glm::vec3(0.0f));
  const std::uint64_t key = mix(mix(mix(static_cast<std::uint64_t>(view)) + static_cast<std::uint64_t>(row)) +
                                static_cast<std::uint64_t>(column));
  for (int sample = 0; sample < options.samples; ++sample)
    addSample(texelPoint(column, row, stratifiedPoint(sample, options.samples, key)),
              options.views[static_cast<std::size_t>(view)], sample, key, sums);
}

BtfBaker::BtfBaker(std::unique_ptr<Tracer> tracer) : tracer_(std::move(tracer)) {}
BtfBaker::BtfBaker(BtfBaker&&) noexcept = default;
BtfBaker& BtfBaker::operator=(BtfBaker&&) noexcept = default;
BtfBaker::~BtfBaker() = default;

Result<BtfBaker> BtfBaker::create(HeightField field, BakeOptions options) {
  WEFT_TRY_VOID(options.validate());
  for (const HeightField::Sample& sample : field.samples) {
    const float least = std::min({sample.albedo.r, sample.albedo.g, sample.albedo.b, sample.specular});
    const float most = std::max({sample.albedo.r, sample.albedo.g, sample.albedo.b}) + sample.specular;
    if (!std::isfinite(sample.height)) return fail("the height field holds a value that is not finite");
    if (!(least >= 0.0f && most <= 1.0f))
      return fail("the height field reflects more light than it receives");
    if (!(sample.roughness >= 0.05f && sample.roughness <= 1.0f))
      return fail("a roughness of " + std::to_string(sample.roughness) + " is out of range", {}, "0.05 to 1");
  }
  auto tracer = std::make_unique<Tracer>(std::move(field), std::move(options));
  WEFT_TRY_VOID(tracer->build());
  return BtfBaker(std::move(tracer));
}

const BakeOptions& BtfBaker::options() const {
  return tracer_->options;
}

void BtfBaker::bakeView(int view, std::span<float> out) const {
  const BakeOptions& options = tracer_->options;
  const auto width = static_cast<std::size_t>(options.width);
  const std::size_t texels = width * static_cast<std::size_t>(options.height);
  const std::size_t lights = options.lights.size();
  WEFT_EXPECT(view >= 0 && static_cast<std::size_t>(view) < options.views.size(), "no such view");
  WEFT_EXPECT(out.size() == lights * texels * 3, "the output must hold lights x rows x columns x 3 values");
  tbb::parallel_for(0, options.height, [&](int row) {
    std::vector<glm::vec3> sums(lights);
    for (int column = 0; column < options.width; ++column) {
      tracer_->bakeTexel(view, column, row, sums);
      const std::size_t texel = static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
      for (std::size_t light = 0; light < lights; ++light) {
        const glm::vec3 value = sums[light] / static_cast<float>(options.samples);
        float* rgb = &out[(light * texels + texel) * 3];
        rgb[0] = value.r;
        rgb[1] = value.g;
        rgb[2] = value.b;
      }
    }
  });
}

}  // namespace weft
