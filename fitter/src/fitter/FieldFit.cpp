#include "weft/fitter/FieldFit.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <future>
#include <mutex>

#include "FittedRows.h"
#include "GatheredRows.h"
#include "RowSaver.h"
#include "weft/core/Contract.h"
#include "weft/core/Version.h"
#include "weft/evaluation/FieldEvaluation.h"
#include "weft/evaluation/HoldOut.h"

namespace weft {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<glm::vec3> without(const std::vector<glm::vec3>& directions, const std::vector<bool>& left) {
  std::vector<glm::vec3> rest;
  for (std::size_t i = 0; i < directions.size(); ++i)
    if (!left[i]) rest.push_back(directions[i]);
  return rest;
}

// Those that are held out, and those on or below the horizon: models differ in what they make of
// these.
std::vector<bool> lightsLeftOut(const std::vector<glm::vec3>& lights, int every) {
  std::vector<bool> left = heldOut(lights, every);
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (lights[i].z <= 0.0f) left[i] = true;
  return left;
}

ReflectanceFieldDescription descriptionOf(const BtfDescription& measured, const FitOptions& options,
                                          const ReflectanceModel& model) {
  const bool stored = options.space == FitSpace::Stored;
  return {without(measured.views, heldOut(measured.views, options.holdOutViews)),
          without(measured.lights, lightsLeftOut(measured.lights, options.holdOutLights)),
          options.cosineInModel || stored || model.containsCosine(),
          stored ? measured.encoding : Encoding::Linear,
          measured.name,
          {}};
}

// Everything that decides the numbers of a fit, for people to compare. What the measurement is
// called does not.
Result<std::string> fingerprintOf(const BtfSource& source, const FitOptions& options, const Crop& crop,
                                  const ModelDescription& model) {
  if (options.partsFolder.empty()) return std::string();
  const BtfDescription& measured = source.description();
  WEFT_TRY(const std::uint64_t checksum, source.checksum());
  std::string fingerprint = fmt::format("weft {} {}", WEFT_VERSION, model.name);
  for (const auto& [name, value] : model.options) fingerprint += fmt::format(" ({} {})", name, textOf(value));
  return fingerprint +
         fmt::format(
             " of {}x{}x{}x{} with checksum {:016x}, crop {} {} {} {}, cosine {}, space {}, hold "
             "out {} {}, {}",
             measured.width, measured.height, measured.views.size(), measured.lights.size(), checksum, crop.x,
             crop.y, crop.width, crop.height, options.cosineInModel ? "in" : "out",
             options.space == FitSpace::Linear ? "linear" : "stored", options.holdOutLights,
             options.holdOutViews, options.precision == Precision::Half ? "half" : "float");
}

// Those that are held out are never asked for.
std::vector<glm::ivec2> ofMeasuredViews(const std::vector<glm::ivec2>& offsets, const FittedPairs& pairs) {
  if (offsets.empty()) return {};
  std::vector<glm::ivec2> all;
  std::size_t next = 0;
  for (const bool isFitted : pairs.views()) all.push_back(isFitted ? offsets[next++] : glm::ivec2(0));
  return all;
}

Result<void> checkComplete(const PassRows& rows, int height) {
  const int missing = rows.firstMissing();
  if (missing < height) return fail(fmt::format("row {} has not been fitted", missing));
  return {};
}

// Calls back one thread at a time, with what is done of all rows of all passes.
class RowCounter {
 public:
  RowCounter(int done, int total, const Progress& progress)
      : done_(done), total_(total), progress_(progress) {}

  void add() {
    const std::scoped_lock lock(mutex_);
    ++done_;
    if (progress_) progress_(static_cast<double>(done_) / static_cast<double>(total_));
  }

 private:
  int done_;
  int total_;
  const Progress& progress_;
  std::mutex mutex_;
};

}  // namespace

Result<void> FitOptions::validate() const {
  if (memory < (std::size_t{64} << 20))
    return fail("less than 64 MiB of memory for the samples", {}, "ask for more");
  for (int every : {holdOutLights, holdOutViews})
    if (every != 0 && every < 2)
      return fail(fmt::format("every {}th direction cannot be held out", every), {},
                  "0 for none, or 2 and more");
  return {};
}

struct FieldFit::Data {
  const BtfSource& source;
  FitOptions options;
  Crop crop;
  std::shared_ptr<const ReflectanceModel> model;
  std::unique_ptr<FieldFitter> fitter;
  ReflectanceFieldDescription description;
  FieldFormula formula;
  FittedPairs pairs;
  PartsFolder folder;
  std::vector<std::unique_ptr<GatheredRows>> gathered;  ///< of each gathering pass
  FittedRows rows;
  std::optional<ErrorMeter> meter;       ///< in the last pass, where it measuresRows()
  std::vector<glm::ivec2> registration;  ///< a measured view; empty: they are not
  std::size_t pass = 0;
  double secondsReading = 0.0;
  double secondsFitting = 0.0;

  Data(const BtfSource& source_, const FitOptions& options_, const Crop& crop_, const FieldFormula& formula_,
       std::shared_ptr<const ReflectanceModel> model_, std::unique_ptr<FieldFitter> fitter_,
       ReflectanceFieldDescription description_, std::string fingerprint);

  bool inLastPass() const { return pass == gathered.size(); }
  /// Whether the errors of a row are known as soon as it is fitted.
  bool measuresRows() const { return registration.empty() && model->summedLevels() == 0; }
  bool isStopped() const { return options.stopped && options.stopped(); }
  PassRows& passRows() { return inLastPass() ? static_cast<PassRows&>(rows) : *gathered[pass]; }
  Result<void> beginPass();
  int halo() const;
  Result<void> measureErrors(const std::vector<FieldLevel>& levels);
  std::vector<RowRange> blocksToDo(int firstRow, int count);
  Result<void> doBlocks(const std::vector<RowRange>& blocks, RowSaver& saver, RowCounter& counter);
  void doBlock(const SampleWindow& samples, RowRange block, RowSaver& saver, RowCounter& counter);
  void gatherRow(const SampledRow& row);
  void fitRow(const SampledRow& row);
};

FieldFit::Data::Data(const BtfSource& source_, const FitOptions& options_, const Crop& crop_,
                     const FieldFormula& formula_, std::shared_ptr<const ReflectanceModel> model_,
                     std::unique_ptr<FieldFitter> fitter_, ReflectanceFieldDescription description_,
                     std::string fingerprint)
    : source(source_),
      options(options_),
      crop(crop_),
      model(std::move(model_)),
      fitter(std::move(fitter_)),
      description(std::move(description_)),
      formula(formula_),
      pairs(description, source.description()),
      folder(options.partsFolder, std::move(fingerprint)),
      rows(folder, fitter->gatheringPasses(), crop.width, crop.height, formula) {
  for (int i = 0; i < fitter->gatheringPasses(); ++i)
    gathered.push_back(std::make_unique<GatheredRows>(folder, i, crop.height));
}

int FieldFit::Data::halo() const {
  int farthest = 0;
  for (const glm::ivec2 offset : registration) farthest = std::max(farthest, std::abs(offset.y));
  return farthest;
}

Result<void> FieldFit::Data::beginPass() {
  registration = ofMeasuredViews(fitter->registration(), pairs);
  if (!inLastPass()) return {};
  const auto tables = std::make_shared<const FieldTables>(fitter->tables());
  WEFT_TRY(const auto bound, boundModel(model, tables));
  WEFT_TRY(const FieldFormula complete, FieldFormula::create(bound, description));
  meter.emplace(complete, pairs, source.description());
  return {};
}

// The rows that are not done, in runs that fit into memory; where there are several, two at once.
std::vector<RowRange> FieldFit::Data::blocksToDo(int firstRow, int count) {
  const int around = 2 * halo();
  const bool fitsAtOnce = source.rowsWithin(options.memory) >= std::min(count + around, crop.height);
  const int atOnce = fitsAtOnce ? count : std::max(source.rowsWithin(options.memory / 2) - around, 1);
  std::vector<RowRange> blocks;
  for (int row = firstRow; row < firstRow + count; ++row) {
    if (passRows().isDone(row)) continue;
    const bool continues = !blocks.empty() && blocks.back().first + blocks.back().count == row;
    if (continues && blocks.back().count < atOnce)
      ++blocks.back().count;
    else
      blocks.push_back({row, 1});
  }
  return blocks;
}

Result<void> FieldFit::Data::doBlocks(const std::vector<RowRange>& blocks, RowSaver& saver,
                                      RowCounter& counter) {
  std::array<SampleWindow, 2> samples;
  const auto readInto = [&](SampleWindow& to, RowRange block) {
    return std::async(std::launch::async,
                      [&, block] { return to.read(source, crop, block.first, block.count, halo()); });
  };
  std::future<Result<void>> reading;
  if (!blocks.empty()) reading = readInto(samples[0], blocks[0]);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto startOfReading = Clock::now();
    WEFT_TRY_VOID(reading.get());
    secondsReading += secondsSince(startOfReading);
    if (i + 1 < blocks.size()) reading = readInto(samples[(i + 1) % 2], blocks[i + 1]);
    const auto startOfFitting = Clock::now();
    doBlock(samples[i % 2], blocks[i], saver, counter);
    secondsFitting += secondsSince(startOfFitting);
    if (isStopped()) return fail("the fit was stopped");
  }
  return {};
}

void FieldFit::Data::doBlock(const SampleWindow& samples, RowRange block, RowSaver& saver,
                             RowCounter& counter) {
  tbb::parallel_for(0, block.count, [&](int i) {
    if (isStopped()) return;
    const SampledRow row{samples, source.description(), pairs, crop, block.first + i, registration};
    inLastPass() ? fitRow(row) : gatherRow(row);
    passRows().setDone({row.y, 1});
    saver.wake();
    counter.add();
  });
}

// Run after run, so that sums of floats do not depend on threads.
void FieldFit::Data::gatherRow(const SampledRow& row) {
  const int length = fitter->texelsAtOnce();
  for (int number = 0; number < TexelRun::runsIn(crop.width, length); ++number) {
    TexelRun run(row, number, length);
    fitter->gather(static_cast<int>(pass), run, gathered[pass]->of(row.y));
  }
}

void FieldFit::Data::fitRow(const SampledRow& row) {
  const int length = fitter->texelsAtOnce();
  tbb::parallel_for(0, TexelRun::runsIn(crop.width, length), [&](int number) {
    TexelRun run(row, number, length);
    RunParameters parameters(formula, run.size());
    fitter->fit(run, parameters);
    if (options.precision == Precision::Half) parameters.roundToHalf();
    rows.put(run.x(), run.y(), parameters);
    if (measuresRows()) meter->measure(parameters, run, rows.errorsAt(run.x(), run.y(), run.size()));
  });
}

FieldFit::FieldFit(std::unique_ptr<Data> data) : data_(std::move(data)) {}
FieldFit::FieldFit(FieldFit&&) noexcept = default;
FieldFit::~FieldFit() = default;

Result<FieldFit> FieldFit::create(const BtfSource& source, const FitOptions& options) {
  const BtfDescription& measured = source.description();
  WEFT_TRY_VOID(options.validate());
  WEFT_TRY(const Crop crop, checkedCrop(options.crop, measured));
  WEFT_TRY(std::shared_ptr<const ReflectanceModel> model, options.models.create(options.model));
  ReflectanceFieldDescription description = descriptionOf(measured, options, *model);
  WEFT_TRY(const FieldFormula formula, FieldFormula::create(model, description));
  WEFT_TRY(std::unique_ptr<FieldFitter> fitter,
           options.fitters.create({description.views, description.lights, description.hasCosine,
                                   options.space == FitSpace::Linear, model, measured.encoding, crop.width,
                                   crop.height}));
  WEFT_TRY(std::string fingerprint, fingerprintOf(source, options, crop, model->description()));
  auto data = std::make_unique<Data>(source, options, crop, formula, std::move(model), std::move(fitter),
                                     std::move(description), std::move(fingerprint));
  WEFT_TRY_VOID(data->beginPass());
  return FieldFit(std::move(data));
}

int FieldFit::height() const {
  return data_->crop.height;
}

Result<void> FieldFit::claimParts() {
  WEFT_EXPECT(data_->folder.keepsRows(), "there is a parts folder");
  return data_->folder.claim();
}

Result<void> FieldFit::resume() {
  for (const auto& pass : data_->gathered) WEFT_TRY_VOID(pass->load());
  return data_->rows.load();
}

Result<void> FieldFit::fitRows(int firstRow, int count, const Progress& progress) {
  Data& data = *data_;
  const int passes = static_cast<int>(data.gathered.size()) + 1;
  RowCounter counter(static_cast<int>(data.pass) * count, passes * count, progress);
  for (int row = firstRow; row < firstRow + count; ++row)
    if (data.passRows().isDone(row)) counter.add();
  const std::vector<RowRange> blocks = data.blocksToDo(firstRow, count);
  RowSaver saver(data.passRows(), data.options.secondsBetweenSaves, data.options.warn);
  const Result<void> done = data.doBlocks(blocks, saver, counter);
  const Result<void> saved = saver.finish();
  return done ? saved : done;
}

bool FieldFit::inLastPass() const {
  return data_->inLastPass();
}

Result<void> FieldFit::nextPass() {
  Data& data = *data_;
  WEFT_EXPECT(!data.inLastPass(), "there is a pass to come");
  GatheredRows& gathered = *data.gathered[data.pass];
  if (gathered.firstMissing() < data.crop.height) WEFT_TRY_VOID(gathered.load());
  WEFT_TRY_VOID(checkComplete(gathered, data.crop.height));
  WEFT_TRY_VOID(data.fitter->endPass(static_cast<int>(data.pass), gathered.all()));
  ++data.pass;
  return data.beginPass();
}

Result<FitResult> FieldFit::finish() {
  Data& data = *data_;
  WEFT_EXPECT(data.inLastPass(), "all passes are done");
  WEFT_TRY_VOID(checkComplete(data.rows, data.crop.height));
  if (data.options.precision == Precision::Half) {
    data.rows.shared.setPrecision(Precision::Half);
    data.rows.layers.setPrecision(Precision::Half);
  }
  std::vector<FieldLevel> levels =
      data.fitter->levels({std::move(data.rows.shared), std::move(data.rows.layers)});
  if (!data.measuresRows()) WEFT_TRY_VOID(data.measureErrors(levels));
  const FitErrors errors = summarize(data.rows.errors, &SplitErrors::fitted);
  std::optional<FitErrors> heldOut;
  if (data.pairs.holdOut()) heldOut = summarize(data.rows.errors, &SplitErrors::heldOut);
  data.description.fitReport = toJson(errors, heldOut);
  WEFT_TRY(ReflectanceField field, ReflectanceField::create(data.model, std::move(data.description),
                                                            std::move(levels), data.fitter->tables()));
  return FitResult{std::move(field),   errors, heldOut, std::move(data.rows.errors), data.secondsReading,
                   data.secondsFitting};
}

// What texels of a registered surface show at other places is known when all have been fitted, as
// are coarser levels that they are summed with.
Result<void> FieldFit::Data::measureErrors(const std::vector<FieldLevel>& levels) {
  WEFT_TRY(const ReflectanceField field,
           ReflectanceField::create(model, description, levels, fitter->tables()));
  WEFT_TRY(FieldEvaluation evaluation, evaluateField(field, source, crop, options.memory));
  rows.errors = std::move(evaluation.texels);
  return {};
}

void FieldFit::removeParts() const {
  data_->folder.remove();
}

Result<FitResult> fitReflectanceField(const BtfSource& source, const FitOptions& options,
                                      const Progress& progress) {
  WEFT_TRY(FieldFit fit, FieldFit::create(source, options));
  WEFT_TRY_VOID(fit.fitRows(0, fit.height(), progress));
  while (!fit.inLastPass()) {
    WEFT_TRY_VOID(fit.nextPass());
    WEFT_TRY_VOID(fit.fitRows(0, fit.height(), progress));
  }
  return fit.finish();
}

}  // namespace weft
