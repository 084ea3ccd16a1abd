#include "FlatScene.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "ChangeClock.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/Switch.h"
#include "weft/scenegraph/Transform.h"

namespace weft {

/// A node on the way down through a changed tree, and where the branches of its children still
/// stand.
struct FlatScene::Visit {
  const Node* node = nullptr;
  std::uint32_t entry = 0;  ///< in the new array
  std::uint32_t child = 0;  ///< the next one
  std::uint32_t old = 0;    ///< the next child's branch in the old array ...
  std::uint32_t oldEnd = 0;
  std::uint32_t oldChild = 0;  ///< its number among its brothers there
  bool moved = false;
};

namespace {

constexpr std::uint32_t kNew = kNone;

}  // namespace

std::unique_lock<std::mutex> FlatScene::look() {
  std::unique_lock lock(mutex_);
  const std::uint64_t now = changeClock++;
  updatedNodes_ = 0;
  if (entries_.empty() || root_.childrenChange_ > lastLook_)
    rebuild();
  else if (root_.branchChange_ > lastLook_)
    updateInPlace();
  lastLook_ = now;
  boxes_.update();
  updateMaterials();
  if (std::exchange(objectsChanged_, false)) objectsChange_ = now;
  return lock;
}

const Node* FlatScene::undressed() const {
  const auto place = materialNumbers_.find(nullptr);
  if (place == materialNumbers_.end()) return nullptr;
  for (const FlatObject& object : objects_.all())
    if (object.node && object.material == place->second) return object.node;
  return nullptr;
}

bool FlatScene::shows(Level level, const glm::dvec3& eye) const {
  while (level.lod != kNone) {
    const PlacedLOD& lod = lods_[level.lod];
    const std::vector<float>& ranges = lod.core->ranges();
    const auto shown = std::upper_bound(ranges.begin(), ranges.end(), glm::distance(eye, lod.center));
    if (shown - ranges.begin() != static_cast<std::ptrdiff_t>(level.child)) return false;
    level = lod.level;
  }
  return true;
}

void FlatScene::updateInPlace() {
  struct Above {
    std::uint32_t entry, end, child;
    bool moved;
  };
  std::vector<Above> path;
  for (std::uint32_t i = 0; i < entries_.size();) {
    while (!path.empty() && path.back().end == i) path.pop_back();
    const std::uint32_t child = path.empty() ? 0 : path.back().child++;
    Entry& entry = entries_[i];
    bool moved = !path.empty() && path.back().moved;
    if (!moved && entry.node->branchChange_ <= lastLook_) {
      i += entry.size;
      continue;
    }
    moved = moved || entry.node->coreChange_ > lastLook_;
    if (moved) place(entry, path.empty() ? Inherited() : handDown(entries_[path.back().entry], child));
    path.push_back({i, i + entry.size, 0, moved});
    ++i;
  }
}

void FlatScene::rebuild() {
  std::vector<Entry> next;
  next.reserve(entries_.size());
  std::vector<Visit> path;
  const auto enter = [&](const Node& node, std::uint32_t old, bool renumbered) {
    const Visit* above = path.empty() ? nullptr : &path.back();
    const bool moved = (above && above->moved) || old == kNew || renumbered || node.coreChange_ > lastLook_;
    if (!moved && node.branchChange_ <= lastLook_) {
      next.insert(next.end(), entries_.begin() + old, entries_.begin() + old + entries_[old].size);
      return;
    }
    const auto entry = static_cast<std::uint32_t>(next.size());
    next.push_back(old == kNew ? Entry{&node} : entries_[old]);
    if (moved) place(next.back(), above ? handDown(next[above->entry], above->child - 1) : Inherited());
    const std::uint32_t oldEnd = old == kNew ? kNew : old + entries_[old].size;
    path.push_back({&node, entry, 0, old == kNew ? kNew : old + 1, oldEnd, 0, moved});
  };
  const auto stepOverOld = [&](Visit& visit) {
    visit.old += entries_[visit.old].size;
    ++visit.oldChild;
  };

  enter(root_, entries_.empty() ? kNew : 0, false);
  while (!path.empty()) {
    Visit& visit = path.back();
    if (visit.child < visit.node->children_.size()) {
      const Node& child = *visit.node->children_[visit.child++];
      std::uint32_t old = kNew;
      bool renumbered = false;
      if (visit.old != visit.oldEnd && child.attachment_ <= lastLook_) {
        // Children keep their order; what stands before this one's branch is gone.
        while (entries_[visit.old].node != &child) {
          dropOldBranch(visit.old);
          stepOverOld(visit);
        }
        old = visit.old;
        const Kind kind = next[visit.entry].kind;
        renumbered = (kind == Kind::Switch || kind == Kind::LOD) && visit.oldChild != visit.child - 1;
        stepOverOld(visit);
      }
      enter(child, old, renumbered);
    } else {
      for (; visit.old != visit.oldEnd; stepOverOld(visit)) dropOldBranch(visit.old);
      next[visit.entry].size = static_cast<std::uint32_t>(next.size()) - visit.entry;
      path.pop_back();
    }
  }
  entries_ = std::move(next);
}

FlatScene::Inherited FlatScene::handDown(const Entry& parent, std::uint32_t child) const {
  Inherited below = parent.below;
  if (parent.kind == Kind::Switch) {
    const int choice = static_cast<const Switch&>(parent.node->core()).choice();
    below.shown = below.shown && (choice == Switch::kAll || choice == static_cast<int>(child));
  } else if (parent.kind == Kind::LOD) {
    below.level = {parent.slot, child};
  }
  return below;
}

void FlatScene::place(Entry& entry, const Inherited& above) {
  ++updatedNodes_;
  entry.below = above;
  const NodeCore& core = entry.node->core();
  if (const auto* transform = dynamic_cast<const Transform*>(&core)) {
    become(entry, Kind::Plain);
    entry.below.toWorld = above.toWorld * transform->matrix();
  } else if (const auto* geometry = dynamic_cast<const Geometry*>(&core)) {
    const bool drawn = above.shown && !geometry->mesh()->indices.empty();
    become(entry, drawn ? Kind::Object : Kind::Plain);
    if (drawn) placeObject(entry, *geometry, above);
  } else if (const auto* group = dynamic_cast<const MaterialGroup*>(&core)) {
    become(entry, Kind::Plain);
    if (!above.material && group->material()) entry.below.material = &group->material();
  } else if (dynamic_cast<const Switch*>(&core)) {
    become(entry, Kind::Switch);
  } else if (const auto* lod = dynamic_cast<const LOD*>(&core)) {
    become(entry, Kind::LOD);
    lods_[entry.slot] = {lod, glm::dvec3(above.toWorld * glm::dvec4(lod->center(), 1.0)), above.level};
  } else if (const auto* light = dynamic_cast<const Light*>(&core); light && above.shown) {
    become(entry, Kind::Light);
    lights_[entry.slot] = {light, above.toWorld, above.level};
  } else {
    become(entry, Kind::Plain);
  }
}

void FlatScene::placeObject(const Entry& entry, const Geometry& geometry, const Inherited& above) {
  objectsChanged_ = true;
  const glm::dmat4& toWorld = above.toWorld;
  const glm::dmat3 rows = glm::transpose(glm::dmat3(toWorld));
  FlatObject& object = objects_[entry.slot];
  for (int row = 0; row < 3; ++row) object.model.rows[row] = glm::vec4(rows[row], 0.0f);
  object.mirrored = glm::determinant(rows) < 0.0;
  object.level = above.level;
  object.node = entry.node;

  static const std::shared_ptr<const Material> none;
  const std::uint32_t mesh = useMesh(geometry.mesh());
  const std::uint32_t material = useMaterial(above.material ? *above.material : none);
  leaveMesh(std::exchange(object.mesh, mesh));
  leaveMaterial(std::exchange(object.material, material));

  const Bounds& bounds = geometry.bounds();
  const glm::dvec3 extent = 0.5 * (bounds.maximum - bounds.minimum);
  glm::dvec3 worldExtent(0.0);
  for (int axis = 0; axis < 3; ++axis) worldExtent += glm::abs(glm::dvec3(toWorld[axis])) * extent[axis];
  boxes_.set(entry.slot, glm::dvec3(toWorld * glm::dvec4(bounds.center(), 1.0)), worldExtent);
}

void FlatScene::become(Entry& entry, Kind kind) {
  if (entry.kind == kind) return;
  if (entry.kind == Kind::Object) {
    objectsChanged_ = true;
    leaveMesh(objects_[entry.slot].mesh);
    leaveMaterial(objects_[entry.slot].material);
    boxes_.clear(entry.slot);
    objects_.remove(entry.slot);
  }
  if (entry.kind == Kind::Light) lights_.remove(entry.slot);
  if (entry.kind == Kind::LOD) lods_.remove(entry.slot);
  entry.kind = kind;
  if (kind == Kind::Object) entry.slot = objects_.add({});
  if (kind == Kind::Light) entry.slot = lights_.add({});
  if (kind == Kind::LOD) entry.slot = lods_.add({});
}

void FlatScene::dropOldBranch(std::uint32_t first) {
  for (std::uint32_t i = first; i < first + entries_[first].size; ++i) become(entries_[i], Kind::Plain);
}

void FlatScene::updateMaterials() {
  for (UsedMaterial& used : materials_.all()) {
    if (!used.material) continue;
    const State& state = used.material->state();
    materialsChanged_ = materialsChanged_ || used.revision != state.revision();
    used.revision = state.revision();
    used.blended = state.at(BlendSlot) != nullptr;
  }
  if (!std::exchange(materialsChanged_, false)) return;
  objectsChanged_ = true;
  // Numbered in the order of their coming, so that the order of drawing does not depend on
  // addresses.
  std::vector<const Chunk*> programs;
  for (UsedMaterial& used : materials_.all()) {
    if (!used.material) continue;
    const Chunk* program = used.material->state().at(ProgramSlot);
    const auto same = std::find_if(programs.begin(), programs.end(), [&](const Chunk* other) {
      return program == other || (program && other && *program == *other);
    });
    used.program = static_cast<std::uint32_t>(same - programs.begin());
    if (same == programs.end()) programs.push_back(program);
  }
}

std::uint32_t FlatScene::useMesh(const std::shared_ptr<const Mesh>& mesh) {
  const auto [place, isNew] = meshNumbers_.try_emplace(mesh.get());
  if (isNew) place->second = meshes_.add({mesh, 0, nextSerial_++});
  ++meshes_[place->second].uses;
  return place->second;
}

std::uint32_t FlatScene::useMaterial(const std::shared_ptr<const Material>& material) {
  const auto [place, isNew] = materialNumbers_.try_emplace(material.get());
  if (isNew) {
    place->second = materials_.add({material});
    materialsChanged_ = true;
  }
  ++materials_[place->second].uses;
  return place->second;
}

void FlatScene::leaveMesh(std::uint32_t number) {
  if (number == kNone || --meshes_[number].uses != 0) return;
  meshNumbers_.erase(meshes_[number].mesh.get());
  meshes_.remove(number);
}

void FlatScene::leaveMaterial(std::uint32_t number) {
  if (number == kNone || --materials_[number].uses != 0) return;
  materialNumbers_.erase(materials_[number].material.get());
  materials_.remove(number);
}

}  // namespace weft
