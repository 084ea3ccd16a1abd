#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <typeindex>
#include <typeinfo>
#include <unordered_map>
#include <utility>

#include "weft/core/Contract.h"
#include "weft/core/Result.h"
#include "weft/shaders/ShaderVariant.h"

namespace weft {

/// What a GL implementation can hold, in texels and bytes.
struct GLLimits {
  int textureSize = 0;  ///< width and height of 2D textures and arrays
  int targetSize = 0;   ///< width and height of what is drawn into
  int textureLayers = 0;
  int volumeSize = 0;
  int cubeSize = 0;
  int rectangleSize = 0;
  int uniformBlockBytes = 0;
  int storageBlockBytes = 0;
};

/// What Weft has made in one GL context: the GL objects of every chunk and mesh that was drawn
/// there, and the errors that came up.
///
/// A window makes one and destroys it, both with its context current; use it only on the thread on
/// which that context is current. Owners of GL objects know nothing of contexts: they may outlive
/// them, or be destroyed on any thread; deleteOrphans() then deletes what they left here.
class GLContext {
 public:
  GLContext();
  ~GLContext();
  GLContext(const GLContext&) = delete;
  GLContext& operator=(const GLContext&) = delete;

  const GLLimits& limits() const { return limits_; }

  /// The GL objects of an owner in this context; default-constructed at the first call, deleted
  /// after the last copy of `owner` is gone. T's destructor runs with the context current. One T an
  /// owner.
  template <class T>
  T& objectsOf(const std::shared_ptr<const void>& owner) {
    Objects& objects = objects_[owner.get()];
    // At the address of an owner that is gone there may be another.
    if (objects.owner.owner_before(owner) || owner.owner_before(objects.owner))
      objects = {owner, std::make_shared<T>(), &typeid(T)};
    WEFT_EXPECT(*objects.type == typeid(T), "an owner has GL objects of one type");
    return *static_cast<T*>(objects.value.get());
  }

  /// What all owners of a kind share in this context, one of each type: default-constructed at the
  /// first call.
  template <class T>
  T& shared() {
    std::shared_ptr<void>& value = shared_[typeid(T)];
    if (!value) value = std::make_shared<T>();
    return *static_cast<T*>(value.get());
  }

  /// What every program that is activated is made with beside its own source: what a renderer keeps
  /// the same for a whole frame, and programs are faster for knowing, as the number of lights.
  const ShaderVariant& programVariant() const { return programVariant_; }
  void setProgramVariant(ShaderVariant variant);
  /// Another one for another variant.
  std::uint64_t programVariantRevision() const { return programVariantRevision_; }

  /// Where programs of this context look for their files first: to edit shaders while an
  /// application runs (reloadPrograms()). Empty for nowhere; set it before the first frame.
  const std::filesystem::path& shaderFolder() const { return shaderFolder_; }
  void setShaderFolder(std::filesystem::path folder) { shaderFolder_ = std::move(folder); }

  /// Deletes the GL objects whose owner is gone, of many owners a share at each call; the renderer
  /// calls it once a frame.
  void deleteOrphans();

  /// Remembers an expected failure that came up where GL objects are made (a shader, a texture too
  /// large).
  void report(Error error);
  /// Has something been reported since takeErrors()?
  bool failed() const { return firstError_.has_value(); }
  /// The first error reported since the last call; drawing went wrong if there is one.
  Result<void> takeErrors();

  /// Makes GL's debug messages about errors and undefined behaviour reports of this context.
  void reportDebugOutput();

 private:
  struct Objects {
    std::weak_ptr<const void> owner;
    std::shared_ptr<void> value;
    const std::type_info* type = nullptr;
  };

  GLLimits limits_;
  std::unordered_map<std::type_index, std::shared_ptr<void>> shared_;
  std::unordered_map<const void*, Objects> objects_;  ///< by the owner's address
  /// of objects_, where deleteOrphans() goes on
  std::size_t nextBucket_ = 0;
  ShaderVariant programVariant_;
  std::uint64_t programVariantRevision_ = 1;
  std::filesystem::path shaderFolder_;
  std::optional<Error> firstError_;
};

}  // namespace weft
