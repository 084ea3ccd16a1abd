#pragma once

#include <map>
#include <memory>
#include <optional>
#include <typeinfo>

#include "weft/core/Contract.h"
#include "weft/core/Result.h"

namespace weft {

/// What a GL implementation can hold, in texels and bytes.
struct GLLimits {
  int textureSize = 0;  ///< width and height of 2D textures, arrays and render targets
  int textureLayers = 0;
  int volumeSize = 0;
  int cubeSize = 0;
  int rectangleSize = 0;
  int uniformBlockBytes = 0;
  int storageBlockBytes = 0;
  int uniformOffsetAlignment = 0;
};

/// What Weft has made in one GL context: the GL objects of every chunk and mesh that was drawn there, and the
/// errors that came up.
///
/// A window makes one and destroys it, both with its context current; use it only on the thread on which that
/// context is current. Owners of GL objects know nothing of contexts: they may outlive them, or be destroyed
/// on any thread; deleteOrphans() then deletes what they left here.
class GLContext {
 public:
  GLContext();
  ~GLContext();
  GLContext(const GLContext&) = delete;
  GLContext& operator=(const GLContext&) = delete;

  const GLLimits& limits() const { return limits_; }

  /// The GL objects of an owner in this context; default-constructed at the first call, deleted after the
  /// last copy of `owner` is gone. T's destructor runs with the context current. One T an owner.
  template <class T>
  T& objectsOf(const std::shared_ptr<const void>& owner) {
    Objects& objects = objects_[owner];
    if (!objects.value) objects = {std::make_shared<T>(), &typeid(T)};
    WEFT_EXPECT(*objects.type == typeid(T), "an owner has GL objects of one type");
    return *static_cast<T*>(objects.value.get());
  }

  /// Deletes the GL objects whose owner is gone; the renderer calls it once a frame.
  void deleteOrphans();

  /// Remembers an expected failure that came up where GL objects are made (a shader, a texture too large).
  void report(Error error);
  /// Has something been reported since takeErrors()?
  bool failed() const { return firstError_.has_value(); }
  /// The first error reported since the last call; drawing went wrong if there is one.
  Result<void> takeErrors();

  /// Makes GL's debug messages about errors and undefined behaviour reports of this context.
  void reportDebugOutput();

 private:
  struct Objects {
    std::shared_ptr<void> value;
    const std::type_info* type = nullptr;
  };

  GLLimits limits_;
  // Compared by control block, which a weak_ptr keeps: unlike an address it is never used again.
  std::map<std::weak_ptr<const void>, Objects, std::owner_less<>> objects_;
  std::optional<Error> firstError_;
};

}  // namespace weft
