#pragma once

#include <cstdint>
#include <glm/ext/matrix_double4x4.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "BoxTable.h"
#include "Table.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/LOD.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/Material.h"
#include "weft/scenegraph/Mesh.h"
#include "weft/scenegraph/Node.h"

namespace weft {

/// A number of nothing.
constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// A child of a LOD node; everything below it has it.
struct Level {
  std::uint32_t lod = kNone;  ///< number in FlatScene::lods()
  std::uint32_t child = 0;

  bool operator==(const Level&) const = default;
};

/// A LOD node in the world.
struct PlacedLOD {
  const LOD* core = nullptr;
  glm::dvec3 center{0.0};
  Level level;  ///< that it hangs below itself
};

/// The first three rows of a matrix from a mesh, around the middle of its bounds, to the world,
/// around the eye, as shaders/mesh.vert takes them.
struct ModelRows {
  glm::vec4 rows[3];
};

/// A geometry at one place of the tree. Where the middle of its mesh's bounds lies is the centre of
/// its box.
struct FlatObject {
  ModelRows model;                 ///< not yet moved
  std::uint32_t mesh = kNone;      ///< number in FlatScene::meshes()
  std::uint32_t material = kNone;  ///< number in FlatScene::materials()
  Level level;
  bool mirrored = false;
  const Node* node = nullptr;
};

struct PlacedLight {
  const Light* core = nullptr;
  glm::dmat4 toWorld{1.0};
  Level level;
};

struct UsedMesh {
  std::shared_ptr<const Mesh> mesh;
  std::uint32_t uses = 0;
  std::uint64_t serial = 0;  ///< of no other mesh that ever had this number
};

struct UsedMaterial {
  std::shared_ptr<const Material> material;  ///< null: nothing gives those objects a material
  std::uint32_t uses = 0;
  std::uint32_t program = 0;   ///< equal programs have the same number
  std::uint64_t revision = 0;  ///< of the state that `program` and `blended` were found for
  bool blended = false;
};

/// What a tree shows, as flat tables: objects with their world matrices and boxes, lights,
/// materials, meshes.
///
/// It belongs to the root, is shared by all who draw or pick from it, and brought up to date before
/// each such look, of which each locks it for its duration. The nodes stand in one array in the
/// order of a walk from the root, each followed by all that is below it, so that a branch without
/// changes is stepped over, or copied as a whole where nodes came or went.
class FlatScene {
 public:
  explicit FlatScene(const Node& root) : root_(root) {}
  /// Made at the first call for a root.
  static FlatScene& of(const Node& root) { return root.flat(); }

  /// Brings the tables up to date; they stay as they are while the lock is held.
  [[nodiscard]] std::unique_lock<std::mutex> look();

  /// How many nodes the latest look() placed anew, since they or something above them changed.
  std::size_t updatedNodes() const { return updatedNodes_; }
  /// Another number, of no other scene, after every look() that found an object or a material
  /// changed.
  std::uint64_t objectsChange() const { return objectsChange_; }
  const Table<FlatObject>& objects() const { return objects_; }
  const BoxTable& boxes() const { return boxes_; }
  const Table<PlacedLight>& lights() const { return lights_; }
  const Table<UsedMesh>& meshes() const { return meshes_; }
  const Table<UsedMaterial>& materials() const { return materials_; }
  /// Who owns what a GL context knows about meshes() by number.
  const std::shared_ptr<const void>& owner() const { return owner_; }

  /// The first object that nothing gives a material, or null.
  const Node* undressed() const;
  /// Is what has this level shown to an eye at this place?
  bool shows(Level level, const glm::dvec3& eye) const;

 private:
  /// What a node gets from above.
  struct Inherited {
    glm::dmat4 toWorld{1.0};
    const std::shared_ptr<const Material>* material = nullptr;  ///< in the core of a MaterialGroup
    Level level;
    bool shown = true;
  };
  enum class Kind : std::uint8_t { Plain, Switch, LOD, Object, Light };
  struct Entry {
    const Node* node = nullptr;
    std::uint32_t size = 1;  ///< entries of the branch, this one included
    std::uint32_t slot = 0;  ///< in the table of its kind
    Kind kind = Kind::Plain;
    Inherited below{};  ///< what it hands down, but for what depends on the child
  };
  struct Visit;

  void updateInPlace();
  void rebuild();
  Inherited handDown(const Entry& parent, std::uint32_t child) const;
  void place(Entry& entry, const Inherited& above);
  void placeObject(const Entry& entry, const Geometry& geometry, const Inherited& above);
  void become(Entry& entry, Kind kind);
  void dropOldBranch(std::uint32_t first);
  void updateMaterials();

  std::uint32_t useMesh(const std::shared_ptr<const Mesh>& mesh);
  std::uint32_t useMaterial(const std::shared_ptr<const Material>& material);
  void leaveMesh(std::uint32_t number);
  void leaveMaterial(std::uint32_t number);

  const Node& root_;
  std::mutex mutex_;
  std::uint64_t lastLook_ = 0;
  std::vector<Entry> entries_;
  Table<FlatObject> objects_;
  BoxTable boxes_;
  Table<PlacedLight> lights_;
  Table<PlacedLOD> lods_;
  Table<UsedMesh> meshes_;
  Table<UsedMaterial> materials_;
  std::unordered_map<const Mesh*, std::uint32_t> meshNumbers_;
  std::unordered_map<const Material*, std::uint32_t> materialNumbers_;
  bool materialsChanged_ = false;
  std::size_t updatedNodes_ = 0;
  bool objectsChanged_ = false;
  std::uint64_t objectsChange_ = 0;
  std::uint64_t nextSerial_ = 1;
  std::shared_ptr<const void> owner_ = std::make_shared<char>();
};

}  // namespace weft
