#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <vector>

#include "weft/core/Result.h"
#include "weft/evaluation/RunParameters.h"
#include "weft/evaluation/TexelRun.h"
#include "weft/reflectance/FieldTables.h"
#include "weft/reflectance/ReflectanceField.h"

namespace weft {

/// Fits a whole field in passes over its samples: first passes that gather what all texels share,
/// then one that gives each texel its parameters. One class a model; TexelFitter is for models
/// whose texels share nothing.
///
/// A pass sees the texels in runs, in any order and by several threads or processes. What it
/// gathers is kept a row and handed over in the order of rows, so that a fit gives the same bytes
/// however it is shared out.
class FieldFitter {
 public:
  virtual ~FieldFitter() = default;

  /// How many passes gather. Texels are fitted in one more.
  virtual int gatheringPasses() const { return 0; }
  /// Adds what a run of texels gives in a gathering pass to what its row gave before, which is
  /// empty at first: sums, or samples of some texels. Runs of a row come in their order; rows in
  /// any, at once.
  virtual void gather(int pass, TexelRun& texels, std::vector<double>& ofRow) const;
  /// Ends a gathering pass with what each row gave, in their order. What is made of it must depend
  /// on nothing else: every process makes it for itself.
  virtual Result<void> endPass(int pass, std::span<const std::vector<double>> ofRows);
  /// How far from where it is each fitted view shows a texel of the surface, in texels, y up: the
  /// passes after it is known, and fit(), are given the surface's texels. Empty: where they are.
  virtual std::vector<glm::ivec2> registration() const { return {}; }
  /// What all texels share, by name; complete after the last gathering pass.
  virtual FieldTables tables() const { return {}; }

  /// How many texels fit() takes best at once.
  virtual int texelsAtOnce() const { return TexelRun::kTexels; }
  /// Fits the texels of a run, base colours included; every number written is finite. Thread safe.
  virtual void fit(TexelRun& texels, RunParameters& parameters) const = 0;
  /// Whether fit() makes the coarser levels, too, down to one texel, from samples that are averages
  /// of finer ones. Such fitters have no registration().
  virtual bool fitsLevels() const { return false; }
  /// Otherwise: the levels of a field, from what fit() gave; of the finest alone by default.
  virtual std::vector<FieldLevel> levels(FieldLevel finest) const;
};

/// The sum of what rows gave, which are of equal length, in the order of rows.
std::vector<double> addedUp(std::span<const std::vector<double>> ofRows);

}  // namespace weft
