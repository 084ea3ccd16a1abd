#include "weft/fitter/Fitter.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <mutex>

#include "FitWeights.h"
#include "RfnlFitter.h"
#include "RfpFitter.h"

namespace weft {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Result<Crop> checkedCrop(const std::optional<Crop>& wanted, const BtfDescription& source) {
  if (!wanted) return Crop{0, 0, source.width, source.height};
  const Crop& c = *wanted;
  if (c.x < 0 || c.y < 0 || c.width < 1 || c.height < 1 || c.width > source.width - c.x ||
      c.height > source.height - c.y)
    return fail(fmt::format("the crop {} {} {} {} is not inside the {} x {} texels", c.x, c.y, c.width,
                            c.height, source.width, source.height));
  return c;
}

// Everything that is the same for all texels while a field is fitted.
struct FitJob {
  const BtfDescription& source;
  const FitOptions& options;
  const TexelFitter& fitter;
  const FieldFormula& formula;
  FloatImage& shared;
  FloatImage& views;

  // Samples `[view][light]` of one texel, which become linear RGB with n.l; numbers that are none become
  // black.
  void fitTexel(std::span<glm::vec3> samples, int x, int y, TexelErrors& errors) const;

 private:
  void measure(std::span<const glm::vec3> samples, int x, int y, TexelErrors& errors) const;
};

void FitJob::fitTexel(std::span<glm::vec3> samples, int x, int y, TexelErrors& errors) const {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    glm::vec3& sample = samples[i];
    if (!std::isfinite(sample.x + sample.y + sample.z)) sample = glm::vec3(0.0f);
    if (!source.cosineInData) sample *= std::max(source.lights[i % source.lights.size()].z, 0.0f);
  }
  const std::span<float> sharedTexel = shared.texel(x, y);
  const glm::vec3 baseColor = fitBaseColor(samples);
  std::vector<float> luminances;
  luminances.reserve(samples.size());
  for (const glm::vec3 sample : samples) luminances.push_back(targetLuminance(sample, baseColor));
  for (int c = 0; c < 3; ++c) sharedTexel[static_cast<std::size_t>(c)] = baseColor[c];

  const std::size_t channels = views.channels().size();
  std::vector<float> viewParameters(source.views.size() * channels);
  fitter.fit(luminances, displayWeights(luminances), sharedTexel.subspan(3), viewParameters);
  for (std::size_t view = 0; view < source.views.size(); ++view)
    std::copy_n(viewParameters.begin() + static_cast<std::ptrdiff_t>(view * channels), channels,
                views.texel(x, y, static_cast<int>(view)).begin());
  if (options.precision == Precision::Half) {
    for (float& value : sharedTexel) value = roundToHalf(value);
    for (int view = 0; view < views.layers(); ++view)
      for (float& value : views.texel(x, y, view)) value = roundToHalf(value);
  }
  measure(samples, x, y, errors);
}

void FitJob::measure(std::span<const glm::vec3> samples, int x, int y, TexelErrors& errors) const {
  const float grazingZ = std::cos(glm::radians(59.9f));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::size_t view = i / source.lights.size();
    const glm::vec3 value = formula.evaluate(shared.texel(x, y), views.texel(x, y, static_cast<int>(view)),
                                             source.lights[i % source.lights.size()], source.views[view]);
    errors.add(samples[i], value, source.encoding, source.views[view].z < grazingZ);
  }
}

// Calls back one thread at a time, with what is done of all texels.
class TexelCounter {
 public:
  TexelCounter(std::size_t total, const Progress& progress) : total_(total), progress_(progress) {}

  void add(std::size_t texels) {
    const std::scoped_lock lock(mutex_);
    done_ += texels;
    if (progress_) progress_(static_cast<double>(done_) / static_cast<double>(total_));
  }

 private:
  std::size_t total_;
  std::size_t done_ = 0;
  const Progress& progress_;
  std::mutex mutex_;
};

}  // namespace

Result<void> FitOptions::validate() const {
  if (memory < (std::size_t{64} << 20))
    return fail("less than 64 MiB of memory for the samples", {}, "ask for more");
  return {};
}

FitterRegistry FitterRegistry::builtin() {
  FitterRegistry registry;
  registry.add("rfp", RfpFitter::create);
  registry.add("rfnl", RfnlFitter::create);
  return registry;
}

void FitterRegistry::add(std::string model, Factory factory) {
  factories_.emplace_back(std::move(model), factory);
}

Result<std::unique_ptr<TexelFitter>> FitterRegistry::create(const FitProblem& problem) const {
  const std::string name = problem.model->description().name;
  for (const auto& [model, factory] : factories_)
    if (model == name) return factory(problem);
  return fail(fmt::format("there is no fitter for the model '{}'", name));
}

Result<FitResult> fitReflectanceField(const BtfSource& source, const FitOptions& options,
                                      const Progress& progress) {
  const BtfDescription& measured = source.description();
  WEFT_TRY_VOID(options.validate());
  WEFT_TRY(const Crop crop, checkedCrop(options.crop, measured));
  WEFT_TRY(std::shared_ptr<const ReflectanceModel> model, ModelRegistry::builtin().create(options.model));
  WEFT_TRY(const std::unique_ptr<TexelFitter> fitter,
           FitterRegistry::builtin().create({measured.views, measured.lights, options.cosineInModel, model}));

  FloatImage shared(crop.width, crop.height, model->sharedChannels());
  FloatImage views(crop.width, crop.height, model->layerChannels(), static_cast<int>(measured.views.size()));
  ReflectanceFieldDescription description{measured.views,   measured.lights, options.cosineInModel,
                                          Encoding::Linear, measured.name,   {}};
  WEFT_TRY(const FieldFormula formula, FieldFormula::create(model, description));
  const FitJob job{measured, options, *fitter, formula, shared, views};
  std::vector<TexelErrors> errors(static_cast<std::size_t>(crop.width) *
                                  static_cast<std::size_t>(crop.height));
  TexelCounter counter(errors.size(), progress);
  double secondsReading = 0.0;
  double secondsFitting = 0.0;

  const int rowsAtOnce = std::min(source.rowsWithin(options.memory), crop.height);
  SampleRows block;
  for (int first = 0; first < crop.height; first += rowsAtOnce) {
    const int rows = std::min(rowsAtOnce, crop.height - first);
    const auto startOfReading = Clock::now();
    WEFT_TRY_VOID(source.readRows(crop.y + first, rows, block));
    secondsReading += secondsSince(startOfReading);
    const auto startOfFitting = Clock::now();
    tbb::parallel_for(0, rows * crop.width, [&](int i) {
      const int x = i % crop.width;
      const int row = i / crop.width;
      std::vector<glm::vec3> samples(block.pairs());
      block.linear(row, crop.x + x, samples);
      job.fitTexel(samples, x, first + row,
                   errors[static_cast<std::size_t>(first + row) * static_cast<std::size_t>(crop.width) +
                          static_cast<std::size_t>(x)]);
      if (x == crop.width - 1) counter.add(static_cast<std::size_t>(crop.width));
    });
    secondsFitting += secondsSince(startOfFitting);
  }
  if (options.precision == Precision::Half) {
    shared.setPrecision(Precision::Half);
    views.setPrecision(Precision::Half);
  }

  const FitErrors summary = summarize(errors);
  description.fitReport = toJson(summary);
  WEFT_TRY(ReflectanceField field,
           ReflectanceField::create(model, std::move(description), std::move(shared), std::move(views)));
  return FitResult{std::move(field), summary, secondsReading, secondsFitting};
}

}  // namespace weft
