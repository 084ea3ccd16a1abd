#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "weft/core/HemisphereTriangulation.h"
#include "weft/core/Result.h"
#include "weft/measurement/BtfSource.h"
#include "weft/measurement/Crop.h"

namespace weft {

/// A measurement in memory, as a source of many fits and interpolated between its directions: what
/// approximations are compared with where nothing was measured. Immutable, thread safe.
///
/// A value is the mean of 9 measured pairs, those of the three views and three lights around the
/// directions (HemisphereTriangulation). Lights are interpolated as if measured without the
/// foreshortening n.l, which is put back for the direction asked for: so a white Lambertian surface
/// stays one between its lights, and all fade to the terminator below the outermost of them. Lights
/// within 6 degrees of the horizon are taken as they are, since their values cannot be divided by
/// n.l.
class RawBtf : public BtfSource {
 public:
  /// Reads all rows, or those of `crop`, as many bytes as they have (BtfDescription::rowBytes()).
  /// Fails as reading does, on a crop that is not inside, and on directions that cannot be
  /// triangulated.
  static Result<RawBtf> read(const BtfSource& source, const std::optional<Crop>& crop = {});

  const BtfDescription& description() const override { return description_; }
  Result<void> readRows(int firstRow, int rowCount, SampleRows& out) const override;
  /// The measured pairs.
  const SampleRows& samples() const { return samples_; }

  /// Linear RGB of texel (x, y), n.l included; 0 for light below the horizon. Numbers in the
  /// measurement that are none count as 0.
  glm::vec3 evaluate(int x, int y, glm::vec3 light, glm::vec3 view) const;

 private:
  BtfDescription description_;
  SampleRows samples_;
  HemisphereTriangulation views_;
  HemisphereTriangulation lights_;
};

/// One view of a measurement under any lights: those that were measured, or others that are
/// interpolated between them, as [Bosserhoff 2003] (section 6) makes up for lights that are far
/// apart. Thread safe; the raw measurement must outlive it.
class OneViewBtf : public BtfSource {
 public:
  OneViewBtf(const RawBtf& raw, glm::vec3 view, std::vector<glm::vec3> lights);

  const BtfDescription& description() const override { return description_; }
  Result<void> readRows(int firstRow, int rowCount, SampleRows& out) const override;

 private:
  const RawBtf& raw_;
  BtfDescription description_;
};

}  // namespace weft
