#pragma once

#include <memory>
#include <typeinfo>

#include "weft/chunks/GLContext.h"
#include "weft/chunks/Slot.h"

namespace weft {

/// A shareable unit of GL state, as in OpenSG. After deactivate() the slot is again as GL starts
/// up: that is the default of every chunk.
///
/// Making, changing and destroying a chunk touches no GL; its GL objects are made per context when
/// it is first activated there, and brought up to date at a later activation if it changed. It may
/// be built and destroyed on any thread, and is not changed while something is rendered. What fails
/// is reported to the context.
class Chunk {
 public:
  virtual ~Chunk() = default;
  Chunk(const Chunk&) = delete;
  Chunk& operator=(const Chunk&) = delete;

  /// The kind of slots that it fits into: the first of them.
  virtual Slot kind() const = 0;

  /// Do both set the same state? Then a State leaves it as it is.
  bool operator==(const Chunk& other) const {
    return this == &other || (typeid(*this) == typeid(other) && isEqual(other));
  }

  /// Sets its state; the slot is at its default.
  virtual void activate(GLContext& context, unsigned slot) const = 0;
  /// Sets its state; `old`, of the same kind, is active in the slot.
  virtual void changeFrom(GLContext& context, const Chunk& old, unsigned slot) const;
  /// Returns the slot to its default; this chunk is active in it.
  virtual void deactivate(GLContext& context, unsigned slot) const = 0;

 protected:
  Chunk() = default;

 private:
  /// `other` is of the same class, and not this.
  virtual bool isEqual(const Chunk&) const { return false; }
};

}  // namespace weft
