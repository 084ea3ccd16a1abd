#include "MeshPool.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <glm/ext/vector_double3.hpp>

#include "weft/scenegraph/Bounds.h"

namespace weft {

namespace {

/// The vertex of most meshes, and what the others add to it.
struct Vertex {
  glm::vec3 position;
  glm::vec3 normal;
  glm::vec4 tangent;
  glm::vec2 texcoord;
};
struct Extension {
  glm::vec2 texcoord1{0.0f};
  glm::vec4 color{1.0f};
};
static_assert(sizeof(Vertex) == 48 && sizeof(Extension) == 24);

constexpr std::uint32_t kSmallestPage = 1u << 13;  // vertices
constexpr std::uint32_t kLargestPage = 1u << 20;
constexpr std::uint32_t kIndicesPerVertex = 3;

/// All pages of a context that hold a mesh.
struct MeshPool {
  std::vector<std::weak_ptr<MeshPage>> pages;
  std::uint32_t pagesMade = 0;
};

std::size_t vertexBytes(bool extended) {
  return sizeof(Vertex) + (extended ? sizeof(Extension) : 0);
}

GLenum modeOf(Topology topology) {
  switch (topology) {
    case Topology::Triangles:
      return GL_TRIANGLES;
    case Topology::Lines:
      return GL_LINES;
    case Topology::Points:
      return GL_POINTS;
  }
  return GL_NONE;
}

void expectValid(const Mesh& mesh) {
  const std::size_t count = mesh.positions.size();
  WEFT_EXPECT(mesh.normals.size() == count && mesh.tangents.size() == count && mesh.texcoords.size() == count,
              "every attribute of a mesh has a value for every position");
  WEFT_EXPECT((mesh.texcoords1.empty() || mesh.texcoords1.size() == count) &&
                  (mesh.colors.empty() || mesh.colors.size() == count),
              "an attribute that a mesh has, it has for every position");
  WEFT_EXPECT(
      mesh.indices.size() % verticesPer(mesh.topology) == 0 &&
          std::all_of(mesh.indices.begin(), mesh.indices.end(), [&](std::uint32_t i) { return i < count; }),
      "a mesh's indices are whole triangles, lines or points of existing vertices");
}

bool isExtended(const Mesh& mesh) {
  return !mesh.texcoords1.empty() || !mesh.colors.empty();
}

std::vector<std::byte> interleaved(const Mesh& mesh) {
  const bool extended = isExtended(mesh);
  const glm::dvec3 center = boundsOf(mesh).center();
  std::vector<std::byte> bytes(mesh.positions.size() * vertexBytes(extended));
  std::byte* out = bytes.data();
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vertex vertex{glm::dvec3(mesh.positions[i]) - center, mesh.normals[i], mesh.tangents[i],
                        mesh.texcoords[i]};
    std::memcpy(out, &vertex, sizeof vertex);
    if (extended) {
      Extension extension;
      if (!mesh.texcoords1.empty()) extension.texcoord1 = mesh.texcoords1[i];
      if (!mesh.colors.empty()) extension.color = mesh.colors[i];
      std::memcpy(out + sizeof vertex, &extension, sizeof extension);
    }
    out += vertexBytes(extended);
  }
  return bytes;
}

GLBuffer makeBuffer(std::size_t bytes, const void* data = nullptr) {
  auto buffer = createGL<GLBuffer>(glCreateBuffers);
  glNamedBufferStorage(buffer, static_cast<GLsizeiptr>(bytes), data, data ? 0 : GL_DYNAMIC_STORAGE_BIT);
  return buffer;
}

void addAttribute(GLuint array, GLuint location, GLuint binding, GLint size, std::size_t offset) {
  glVertexArrayAttribFormat(array, location, size, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
  glVertexArrayAttribBinding(array, location, binding);
  glEnableVertexArrayAttrib(array, location);
}

GLVertexArray makeArray(const MeshPage& page) {
  auto array = createGL<GLVertexArray>(glCreateVertexArrays);
  addAttribute(array, 0, kVertexBinding, 3, offsetof(Vertex, position));
  addAttribute(array, 1, kVertexBinding, 3, offsetof(Vertex, normal));
  addAttribute(array, 2, kVertexBinding, 4, offsetof(Vertex, tangent));
  addAttribute(array, 3, kVertexBinding, 2, offsetof(Vertex, texcoord));
  const GLuint binding = page.extended ? kVertexBinding : kAbsentBinding;
  const std::size_t start = page.extended ? sizeof(Vertex) : 0;
  addAttribute(array, 4, binding, 2, start + offsetof(Extension, texcoord1));
  addAttribute(array, 5, binding, 4, start + offsetof(Extension, color));
  for (GLuint row = 0; row < 3; ++row)
    addAttribute(array, kModelLocation + row, kModelBinding, 4, row * sizeof(glm::vec4));
  glVertexArrayBindingDivisor(array, kModelBinding, 1);

  glVertexArrayVertexBuffer(array, kVertexBinding, page.vertices, 0,
                            static_cast<GLsizei>(vertexBytes(page.extended)));
  // A stride of 0: all vertices have the same.
  if (!page.extended) glVertexArrayVertexBuffer(array, kAbsentBinding, page.absent, 0, 0);
  glVertexArrayElementBuffer(array, page.indices);
  return array;
}

/// A page with room for the mesh, and the room.
void takeRoom(MeshPool& pool, bool extended, MeshPlace& place) {
  const auto takeFrom = [&](std::shared_ptr<MeshPage> page) {
    const auto vertex = page->freeVertices.take(place.vertexCount);
    if (!vertex) return false;
    const auto index = page->freeIndices.take(place.indexCount);
    if (!index) {
      page->freeVertices.giveBack(*vertex, place.vertexCount);
      return false;
    }
    place.firstVertex = *vertex;
    place.firstIndex = *index;
    place.page = std::move(page);
    return true;
  };
  std::erase_if(pool.pages, [](const auto& page) { return page.expired(); });
  // The latest page is the one that most likely has room.
  for (auto page = pool.pages.rbegin(); page != pool.pages.rend(); ++page)
    if (auto held = page->lock(); held->extended == extended && takeFrom(std::move(held))) return;

  // Each page is twice the one before, so that few hold the largest scene and a small scene is not
  // charged.
  const std::uint32_t usual =
      std::min(kSmallestPage << std::min<std::size_t>(pool.pages.size(), 16), kLargestPage);
  const std::uint32_t vertices = std::max(usual, place.vertexCount);
  const std::uint32_t indices = std::max(kIndicesPerVertex * usual, place.indexCount);
  auto page = std::make_shared<MeshPage>(extended, vertices, indices, pool.pagesMade++);
  pool.pages.push_back(page);
  takeFrom(std::move(page));
}

void make(GLContext& context, MeshPlace& place, const Mesh& mesh) {
  place.mode = modeOf(mesh.topology);
  place.vertexCount = static_cast<std::uint32_t>(mesh.positions.size());
  place.indexCount = static_cast<std::uint32_t>(mesh.indices.size());
  takeRoom(context.shared<MeshPool>(), isExtended(mesh), place);
  const std::vector<std::byte> vertices = interleaved(mesh);
  const std::size_t stride = vertexBytes(place.page->extended);
  glNamedBufferSubData(place.page->vertices, static_cast<GLintptr>(place.firstVertex * stride),
                       static_cast<GLsizeiptr>(vertices.size()), vertices.data());
  glNamedBufferSubData(place.page->indices, static_cast<GLintptr>(place.firstIndex * sizeof(std::uint32_t)),
                       static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(std::uint32_t)),
                       mesh.indices.data());
}

}  // namespace

MeshPage::MeshPage(bool isExtended, std::uint32_t vertexCount, std::uint32_t indexCount,
                   std::uint32_t pageNumber)
    : extended(isExtended), number(pageNumber), freeVertices(vertexCount), freeIndices(indexCount) {
  vertices = makeBuffer(vertexCount * vertexBytes(extended));
  indices = makeBuffer(indexCount * sizeof(std::uint32_t));
  const Extension extension;
  if (!extended) absent = makeBuffer(sizeof extension, &extension);
  array = makeArray(*this);
}

MeshPlace::~MeshPlace() {
  if (!page) return;
  page->freeVertices.giveBack(firstVertex, vertexCount);
  page->freeIndices.giveBack(firstIndex, indexCount);
}

const MeshPlace& meshPlace(GLContext& context, const std::shared_ptr<const Mesh>& mesh) {
  auto& place = context.objectsOf<MeshPlace>(mesh);
  if (!place.page) {
    expectValid(*mesh);
    make(context, place, *mesh);
  }
  return place;
}

}  // namespace weft
