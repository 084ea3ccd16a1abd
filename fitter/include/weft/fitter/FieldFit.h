#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "weft/core/Progress.h"
#include "weft/core/Result.h"
#include "weft/evaluation/ErrorMeter.h"
#include "weft/evaluation/FitErrors.h"
#include "weft/fitter/FitterRegistry.h"
#include "weft/measurement/BtfSource.h"
#include "weft/measurement/Crop.h"
#include "weft/reflectance/ModelRegistry.h"
#include "weft/reflectance/ReflectanceField.h"

namespace weft {

/// The values that a fit minimises the errors of.
enum class FitSpace {
  Linear,  ///< linear values, residuals weighted as a display shows them: light adds up in these
  Stored,  ///< values as the measurement stores them, unweighted: the literal fit of the papers
};

/// How a fit is made. Every default is what most users want.
struct FitOptions {
  ModelDescription model;
  ModelRegistry models = ModelRegistry::builtin();     ///< among which the model is
  FitterRegistry fitters = FitterRegistry::builtin();  ///< and its fitter
  /// of the stored numbers; half changes eps by less than 0.0001
  Precision precision = Precision::Half;
  /// True: [Meseth 2004]'s literal fit of data that contain n.l; else RF is multiplied by n.l when
  /// shading. Values in FitSpace::Stored and of models that say so (containsCosine()) always
  /// contain it.
  bool cosineInModel = false;
  FitSpace space = FitSpace::Linear;
  std::optional<Crop> crop;  ///< texels to fit; all by default
  int holdOutLights = 0;     ///< about every Nth is not fitted but tested on (HoldOut.h); 0: none
  int holdOutViews = 0;
  std::size_t memory =
      std::size_t{4}  /// bytes for samples; two blocks of rows share it where one does not suffice
      << 30;
  std::filesystem::path partsFolder;  ///< where finished rows are kept; empty: nowhere
  /// Between saves of finished rows: what a stop may cost. 0: they are saved at once, and all are
  /// when fitRows() returns.
  double secondsBetweenSaves = 0.0;
  /// Hears of what goes wrong without ending the fit, as rows that cannot be saved; from any
  /// thread.
  std::function<void(const std::string&)> warn;
  /// Asked before each row, from any thread: true ends the fit, which then fails.
  std::function<bool()> stopped;

  Result<void> validate() const;
};

struct FitResult {
  ReflectanceField field;
  FitErrors errors;                  ///< of the field as stored, over all fitted pairs
  std::optional<FitErrors> heldOut;  ///< over the others, if any were held out
  std::vector<SplitErrors> texels;   ///< row by row
  double secondsReading = 0.0;       ///< waiting for samples
  double secondsFitting = 0.0;
};

/// A fit of a whole measurement in steps, so that it can be stopped and shared. The result does not
/// depend on threads, blocks, stops or shares.
///
///     WEFT_TRY(FieldFit fit, FieldFit::create(source, options));
///     WEFT_TRY_VOID(fit.resume());       // takes over rows in options.partsFolder
///     WEFT_TRY_VOID(fit.fitRows(0, fit.height(), {}));    // or each process some
///     while (!fit.inLastPass()) {                         // tables, then levels
///       WEFT_TRY_VOID(fit.nextPass());   // when all processes are done with the rows
///       WEFT_TRY_VOID(fit.fitRows(0, fit.height(), {}));
///     }
///     WEFT_TRY(FitResult result, fit.finish());
class FieldFit {
 public:
  /// Fails on options that do not suit the measurement, which must outlive the fit. With a parts
  /// folder, looks at all that was measured once (BtfSource::checksum()), so that rows of something
  /// else are not taken over.
  static Result<FieldFit> create(const BtfSource& source, const FitOptions& options);
  FieldFit(FieldFit&&) noexcept;
  ~FieldFit();

  /// Rows of the present pass: of the field, or of one of its coarser levels.
  int height() const;
  /// Keeps other fits away from the parts folder while this one lives. Fails where one has it. Of
  /// several processes that share the fit, one claims it.
  Result<void> claimParts();
  /// Takes over the finished rows in the parts folder. Fails on those of another fit.
  Result<void> resume();
  /// Does the present pass for those of the rows that are not done: texels in parallel, while the
  /// next block of rows is read and finished ones are written to the parts folder. Progress is that
  /// of all passes.
  Result<void> fitRows(int firstRow, int count, const Progress& progress);
  /// The first passes gather what texels share (FieldFitter), then each fits a level, the finest
  /// first.
  bool inLastPass() const;
  /// Goes on to the next pass; gathered rows of other processes are taken over from the parts
  /// folder. Fails where one of them is missing.
  Result<void> nextPass();
  /// The field, once every row of every pass is done; once.
  Result<FitResult> finish();
  /// Removes the finished rows, and the parts folder where nothing else is in it; for when the
  /// field has been written.
  void removeParts() const;

 private:
  struct Data;
  explicit FieldFit(std::unique_ptr<Data> data);
  std::unique_ptr<Data> data_;
};

/// All steps of a FieldFit, without a resume.
Result<FitResult> fitReflectanceField(const BtfSource& source, const FitOptions& options,
                                      const Progress& progress = {});

}  // namespace weft
