#include "weft/fitter/FieldFit.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <future>

#include "FitDescription.h"
#include "FittedRows.h"
#include "GatheredRows.h"
#include "HalvedBtf.h"
#include "RowCounter.h"
#include "RowSaver.h"
#include "weft/core/Contract.h"
#include "weft/evaluation/FieldEvaluation.h"

namespace weft {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
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
  std::vector<std::unique_ptr<FittedRows>> fitted;      ///< of each level
  std::vector<std::unique_ptr<HalvedBtf>> halved;       ///< what each but the finest is fitted to
  std::optional<ErrorMeter> meter;                      ///< of the finest level, where it measuresRows()
  std::vector<glm::ivec2> registration;                 ///< a measured view; empty: they are not
  std::size_t pass = 0;
  double secondsReading = 0.0;
  double secondsFitting = 0.0;

  Data(const BtfSource& source_, const FitOptions& options_, const Crop& crop_, const FieldFormula& formula_,
       std::shared_ptr<const ReflectanceModel> model_, std::unique_ptr<FieldFitter> fitter_,
       ReflectanceFieldDescription description_, std::string fingerprint);

  std::size_t passes() const { return gathered.size() + fitted.size(); }
  bool isGathering() const { return pass < gathered.size(); }
  std::size_t level() const { return isGathering() ? 0 : pass - gathered.size(); }
  const BtfSource& levelSource() const { return level() == 0 ? source : *halved[level() - 1]; }
  Crop levelCrop() const { return cropOf(level()); }
  Crop cropOf(std::size_t ofLevel) const;
  /// Whether the errors of a row are known as soon as it is fitted.
  bool measuresRows() const { return registration.empty() && model->summedLevels() == 0; }
  bool isStopped() const { return options.stopped && options.stopped(); }
  PassRows& passRows() { return isGathering() ? static_cast<PassRows&>(*gathered[pass]) : *fitted[level()]; }
  void addLevels();
  double doneBefore(std::size_t ofPass) const;
  Result<void> beginPass();
  int halo() const;
  Result<void> endGathering();
  Result<std::vector<FieldLevel>> takeLevels();
  Result<void> measureErrors(const std::vector<FieldLevel>& levels);
  std::vector<RowRange> blocksToDo(int firstRow, int count);
  Result<void> doBlocks(const std::vector<RowRange>& blocks, RowSaver& saver, RowCounter& counter);
  void doBlock(const SampleWindow& samples, RowRange block, RowSaver& saver, RowCounter& counter);
  Result<void> keepNextLevel(const SampleWindow& samples, RowRange block);
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
      folder(options.partsFolder, std::move(fingerprint)) {
  for (int i = 0; i < fitter->gatheringPasses(); ++i)
    gathered.push_back(std::make_unique<GatheredRows>(folder, i, crop.height));
  addLevels();
}

// The finest, and those that are fitted as it is.
void FieldFit::Data::addLevels() {
  for (Crop ofLevel = crop;; ofLevel = cropOf(fitted.size())) {
    fitted.push_back(std::make_unique<FittedRows>(folder, static_cast<int>(passes()), ofLevel.width,
                                                  ofLevel.height, formula));
    if (!fitter->fitsLevels() || (ofLevel.width == 1 && ofLevel.height == 1)) return;
    const BtfSource& finer = halved.empty() ? source : *halved.back();
    halved.push_back(std::make_unique<HalvedBtf>(finer, ofLevel, options.memory));
  }
}

// The texels of a level in what it is fitted to.
Crop FieldFit::Data::cropOf(std::size_t ofLevel) const {
  if (ofLevel == 0) return crop;
  const BtfDescription& samples = halved[ofLevel - 1]->description();
  return {0, 0, samples.width, samples.height};
}

// The share of all passes' texels that is done when one begins.
double FieldFit::Data::doneBefore(std::size_t ofPass) const {
  double done = 0.0, total = 0.0;
  for (std::size_t i = 0; i < passes(); ++i) {
    const Crop texels = cropOf(i < gathered.size() ? 0 : i - gathered.size());
    total += static_cast<double>(texels.width) * texels.height;
    if (i + 1 == ofPass) done = total;
  }
  return done / total;
}

int FieldFit::Data::halo() const {
  int farthest = 0;
  for (const glm::ivec2 offset : registration) farthest = std::max(farthest, std::abs(offset.y));
  return farthest;
}

Result<void> FieldFit::Data::beginPass() {
  if (level() > 0) return {};
  registration = ofMeasuredViews(fitter->registration(), pairs);
  if (isGathering()) return {};
  const auto tables = std::make_shared<const FieldTables>(fitter->tables());
  WEFT_TRY(const auto bound, boundModel(model, tables));
  WEFT_TRY(const FieldFormula complete, FieldFormula::create(bound, description));
  meter.emplace(complete, pairs, source.description());
  return {};
}

// The rows that are not done, in runs that fit into memory; where there are several, two at once.
std::vector<RowRange> FieldFit::Data::blocksToDo(int firstRow, int count) {
  const int around = 2 * halo();
  const BtfSource& from = levelSource();
  const bool fitsAtOnce = from.rowsWithin(options.memory) >= std::min(count + around, levelCrop().height);
  const int atOnce = fitsAtOnce ? count : std::max(from.rowsWithin(options.memory / 2) - around, 1);
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
    return std::async(std::launch::async, [&, block] {
      return to.read(levelSource(), levelCrop(), block.first, block.count, halo());
    });
  };
  std::future<Result<void>> reading;
  const auto startOfKeeping = Clock::now();
  if (level() > 0 && !blocks.empty()) WEFT_TRY_VOID(halved[level() - 1]->keep());
  secondsReading += secondsSince(startOfKeeping);
  if (!blocks.empty()) reading = readInto(samples[0], blocks[0]);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto startOfReading = Clock::now();
    WEFT_TRY_VOID(reading.get());
    secondsReading += secondsSince(startOfReading);
    if (i + 1 < blocks.size()) reading = readInto(samples[(i + 1) % 2], blocks[i + 1]);
    const auto startOfFitting = Clock::now();
    doBlock(samples[i % 2], blocks[i], saver, counter);
    WEFT_TRY_VOID(keepNextLevel(samples[i % 2], blocks[i]));
    secondsFitting += secondsSince(startOfFitting);
    if (isStopped()) return fail("the fit was stopped");
  }
  return {};
}

void FieldFit::Data::doBlock(const SampleWindow& samples, RowRange block, RowSaver& saver,
                             RowCounter& counter) {
  tbb::parallel_for(0, block.count, [&](int i) {
    if (isStopped()) return;
    const SampledRow row{samples,     levelSource().description(), pairs, levelCrop(), block.first + i,
                         registration};
    isGathering() ? gatherRow(row) : fitRow(row);
    passRows().setDone({row.y, 1});
    saver.wake();
    counter.add();
  });
}

// While all samples of a level are in memory, those of the next cost no more reading.
Result<void> FieldFit::Data::keepNextLevel(const SampleWindow& samples, RowRange block) {
  const bool hasAll = block.count == levelCrop().height;
  if (isGathering() || isStopped() || !hasAll || level() == halved.size()) return {};
  return halved[level()]->keepFrom(samples);
}

// Run after run, so that sums of floats do not depend on threads.
void FieldFit::Data::gatherRow(const SampledRow& row) {
  const int length = fitter->texelsAtOnce();
  for (int number = 0; number < TexelRun::runsIn(row.crop.width, length); ++number) {
    TexelRun run(row, number, length);
    fitter->gather(static_cast<int>(pass), run, gathered[pass]->of(row.y));
  }
}

void FieldFit::Data::fitRow(const SampledRow& row) {
  const int length = fitter->texelsAtOnce();
  FittedRows& rows = *fitted[level()];
  tbb::parallel_for(0, TexelRun::runsIn(row.crop.width, length), [&](int number) {
    TexelRun run(row, number, length);
    RunParameters parameters(formula, run.size());
    fitter->fit(run, parameters);
    if (options.precision == Precision::Half) parameters.roundToHalf();
    rows.put(run.x(), run.y(), parameters);
    if (level() == 0 && measuresRows())
      meter->measure(parameters, run, rows.errorsAt(run.x(), run.y(), run.size()));
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
  return data_->levelCrop().height;
}

Result<void> FieldFit::claimParts() {
  WEFT_EXPECT(data_->folder.keepsRows(), "there is a parts folder");
  return data_->folder.claim();
}

Result<void> FieldFit::resume() {
  for (const auto& pass : data_->gathered) WEFT_TRY_VOID(pass->load());
  for (const auto& level : data_->fitted) WEFT_TRY_VOID(level->load());
  return {};
}

Result<void> FieldFit::fitRows(int firstRow, int count, const Progress& progress) {
  Data& data = *data_;
  RowCounter counter(data.doneBefore(data.pass), data.doneBefore(data.pass + 1), count, progress);
  for (int row = firstRow; row < firstRow + count; ++row)
    if (data.passRows().isDone(row)) counter.add();
  const std::vector<RowRange> blocks = data.blocksToDo(firstRow, count);
  RowSaver saver(data.passRows(), data.options.secondsBetweenSaves, data.options.warn);
  const Result<void> done = data.doBlocks(blocks, saver, counter);
  const Result<void> saved = saver.finish();
  return done ? saved : done;
}

bool FieldFit::inLastPass() const {
  return data_->pass + 1 == data_->passes();
}

Result<void> FieldFit::nextPass() {
  Data& data = *data_;
  WEFT_EXPECT(!inLastPass(), "there is a pass to come");
  if (data.isGathering()) WEFT_TRY_VOID(data.endGathering());
  ++data.pass;
  return data.beginPass();
}

Result<void> FieldFit::Data::endGathering() {
  GatheredRows& rows = *gathered[pass];
  if (rows.firstMissing() < crop.height) WEFT_TRY_VOID(rows.load());
  WEFT_TRY_VOID(checkComplete(rows, crop.height));
  return fitter->endPass(static_cast<int>(pass), rows.all());
}

// All that were fitted, or what the fitter makes of the finest.
Result<std::vector<FieldLevel>> FieldFit::Data::takeLevels() {
  std::vector<FieldLevel> levels;
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    WEFT_TRY_VOID(checkComplete(*fitted[i], cropOf(i).height));
    FieldLevel level{std::move(fitted[i]->shared), std::move(fitted[i]->layers)};
    if (options.precision == Precision::Half)
      for (FloatImage* image : {&level.shared, &level.layers}) image->setPrecision(Precision::Half);
    levels.push_back(std::move(level));
  }
  return fitter->fitsLevels() ? std::move(levels) : fitter->levels(std::move(levels.front()));
}

Result<FitResult> FieldFit::finish() {
  Data& data = *data_;
  WEFT_EXPECT(inLastPass(), "all passes are done");
  WEFT_TRY(std::vector<FieldLevel> levels, data.takeLevels());
  if (!data.measuresRows()) WEFT_TRY_VOID(data.measureErrors(levels));
  std::vector<SplitErrors>& texels = data.fitted.front()->errors;
  const FitErrors errors = summarize(texels, &SplitErrors::fitted);
  std::optional<FitErrors> heldOut;
  if (data.pairs.holdOut()) heldOut = summarize(texels, &SplitErrors::heldOut);
  data.description.fitReport = toJson(errors, heldOut);
  WEFT_TRY(ReflectanceField field, ReflectanceField::create(data.model, std::move(data.description),
                                                            std::move(levels), data.fitter->tables()));
  return FitResult{std::move(field),   errors, heldOut, std::move(texels), data.secondsReading,
                   data.secondsFitting};
}

// What texels of a registered surface show at other places is known when all have been fitted, as
// are coarser levels that they are summed with.
Result<void> FieldFit::Data::measureErrors(const std::vector<FieldLevel>& levels) {
  WEFT_TRY(const ReflectanceField field,
           ReflectanceField::create(model, description, levels, fitter->tables()));
  WEFT_TRY(FieldEvaluation evaluation, evaluateField(field, source, crop, options.memory));
  fitted.front()->errors = std::move(evaluation.texels);
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
