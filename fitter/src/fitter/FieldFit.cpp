#include "weft/fitter/FieldFit.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <mutex>

#include "FittedRows.h"
#include "TexelJob.h"
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

// Those that are held out, and those on or below the horizon: models differ in what they make of these.
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

// Everything that decides the numbers of a fit, for people to compare.
std::string fingerprintOf(const BtfDescription& measured, const FitOptions& options, const Crop& crop,
                          const ModelDescription& model) {
  std::string fingerprint = "weft " + model.name;
  for (const auto& [name, value] : model.options) fingerprint += fmt::format(" ({} {})", name, textOf(value));
  return fingerprint +
         fmt::format(" of {} {}x{}x{}x{}, crop {} {} {} {}, cosine {}, space {}, hold out {} {}, {}",
                     measured.name, measured.width, measured.height, measured.views.size(),
                     measured.lights.size(), crop.x, crop.y, crop.width, crop.height,
                     options.cosineInModel ? "in" : "out",
                     options.space == FitSpace::Linear ? "linear" : "stored", options.holdOutLights,
                     options.holdOutViews, options.precision == Precision::Half ? "half" : "float");
}

// Calls back one thread at a time, with what is done of all rows.
class RowCounter {
 public:
  RowCounter(int total, const Progress& progress) : total_(total), progress_(progress) {}

  void add() {
    const std::scoped_lock lock(mutex_);
    ++done_;
    if (progress_) progress_(static_cast<double>(done_) / static_cast<double>(total_));
  }

 private:
  int total_;
  int done_ = 0;
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
  std::unique_ptr<TexelFitter> fitter;
  ReflectanceFieldDescription description;
  ErrorMeter meter;
  TexelJob job;
  FittedRows rows;
  double secondsReading = 0.0;
  double secondsFitting = 0.0;
  Clock::time_point lastSave = Clock::now();

  Data(const BtfSource& source_, const FitOptions& options_, const Crop& crop_, const FieldFormula& formula,
       std::shared_ptr<const ReflectanceModel> model_, std::unique_ptr<TexelFitter> fitter_,
       ReflectanceFieldDescription description_)
      : source(source_),
        options(options_),
        crop(crop_),
        model(std::move(model_)),
        fitter(std::move(fitter_)),
        description(std::move(description_)),
        meter(formula, description, source.description()),
        job(source.description(), options, meter, *fitter, *model),
        rows(crop.width, crop.height, formula, options.partsFolder,
             fingerprintOf(source.description(), options, crop, model->description())) {}

  std::vector<RowRange> blocksToFit(int firstRow, int count) const;
  Result<void> fitBlock(const SampleRows& samples, RowRange block, RowCounter& counter);
  void fitPart(const SampleRows& samples, RowRange block, RowRange part, RowCounter& counter);
};

// The rows that are not done, in runs that fit into memory; where there are several, two at once.
std::vector<RowRange> FieldFit::Data::blocksToFit(int firstRow, int count) const {
  const int atOnce =
      source.rowsWithin(options.memory) >= count ? count : source.rowsWithin(options.memory / 2);
  std::vector<RowRange> blocks;
  for (int row = firstRow; row < firstRow + count; ++row) {
    if (rows.isDone(row)) continue;
    const bool continues = !blocks.empty() && blocks.back().first + blocks.back().count == row;
    if (continues && blocks.back().count < atOnce)
      ++blocks.back().count;
    else
      blocks.push_back({row, 1});
  }
  return blocks;
}

Result<void> FieldFit::Data::fitBlock(const SampleRows& samples, RowRange block, RowCounter& counter) {
  constexpr int kParts = 32;  // and what a stop loses at least
  const int partRows = (crop.height + kParts - 1) / kParts;
  tbb::task_group saving;
  std::mutex mutex;
  Result<void> saved;
  for (int first = block.first; first < block.first + block.count; first += partRows) {
    const RowRange part{first, std::min(partRows, block.first + block.count - first)};
    fitPart(samples, block, part, counter);
    rows.setDone(part.first, part.count);
    if (secondsSince(lastSave) < options.secondsBetweenSaves) continue;
    lastSave = Clock::now();
    for (const RowRange unsaved : rows.takeUnsaved())
      saving.run([&, unsaved] {
        Result<void> result = rows.save(unsaved);
        const std::scoped_lock lock(mutex);
        if (!result) saved = std::move(result);
      });
  }
  saving.wait();
  return saved;
}

void FieldFit::Data::fitPart(const SampleRows& samples, RowRange block, RowRange part, RowCounter& counter) {
  tbb::parallel_for(0, part.count * crop.width, [&](int i) {
    const int x = i % crop.width;
    const int y = part.first + i / crop.width;
    job.fit(samples, y - block.first, crop.x + x, rows, x, y);
    if (x == crop.width - 1) counter.add();
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
  WEFT_TRY(std::unique_ptr<TexelFitter> fitter,
           options.fitters.create({description.views, description.lights, description.hasCosine,
                                   options.space == FitSpace::Linear, model}));
  return FieldFit(std::make_unique<Data>(source, options, crop, formula, std::move(model), std::move(fitter),
                                         std::move(description)));
}

int FieldFit::height() const {
  return data_->crop.height;
}

Result<void> FieldFit::resume() {
  return data_->rows.load();
}

Result<void> FieldFit::fitRows(int firstRow, int count, const Progress& progress) {
  Data& data = *data_;
  RowCounter counter(count, progress);
  for (int row = firstRow; row < firstRow + count; ++row)
    if (data.rows.isDone(row)) counter.add();

  std::array<SampleRows, 2> samples;
  const auto readInto = [&](SampleRows& to, RowRange block) {
    return std::async(std::launch::async, [&, block] {
      return data.source.readRows(data.crop.y + block.first, block.count, to);
    });
  };
  const std::vector<RowRange> blocks = data.blocksToFit(firstRow, count);
  std::future<Result<void>> reading;
  if (!blocks.empty()) reading = readInto(samples[0], blocks[0]);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto startOfReading = Clock::now();
    WEFT_TRY_VOID(reading.get());
    data.secondsReading += secondsSince(startOfReading);
    if (i + 1 < blocks.size()) reading = readInto(samples[(i + 1) % 2], blocks[i + 1]);
    const auto startOfFitting = Clock::now();
    WEFT_TRY_VOID(data.fitBlock(samples[i % 2], blocks[i], counter));
    data.secondsFitting += secondsSince(startOfFitting);
  }
  return {};
}

Result<FitResult> FieldFit::finish() {
  Data& data = *data_;
  for (int row = 0; row < data.crop.height; ++row)
    if (!data.rows.isDone(row)) return fail(fmt::format("row {} has not been fitted", row));
  if (data.options.precision == Precision::Half) {
    data.rows.shared.setPrecision(Precision::Half);
    data.rows.layers.setPrecision(Precision::Half);
  }
  const FitErrors errors = summarize(data.rows.errors, &SplitErrors::fitted);
  std::optional<FitErrors> heldOut;
  if (data.meter.holdsOut()) heldOut = summarize(data.rows.errors, &SplitErrors::heldOut);
  data.description.fitReport = toJson(errors, heldOut);
  WEFT_TRY(ReflectanceField field,
           ReflectanceField::create(data.model, std::move(data.description), std::move(data.rows.shared),
                                    std::move(data.rows.layers)));
  return FitResult{std::move(field),   errors, heldOut, std::move(data.rows.errors), data.secondsReading,
                   data.secondsFitting};
}

void FieldFit::removeParts() const {
  data_->rows.remove();
}

Result<FitResult> fitReflectanceField(const BtfSource& source, const FitOptions& options,
                                      const Progress& progress) {
  WEFT_TRY(FieldFit fit, FieldFit::create(source, options));
  WEFT_TRY_VOID(fit.fitRows(0, fit.height(), progress));
  return fit.finish();
}

}  // namespace weft
