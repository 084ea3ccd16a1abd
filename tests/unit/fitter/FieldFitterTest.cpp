// Fitters whose texels share what is gathered over all of them.
#include "weft/fitter/FieldFitter.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <filesystem>

#include "FitPasses.h"
#include "MemoryBtf.h"
#include "TestSupport.h"
#include "weft/fitter/FieldFit.h"
#include "weft/reflectance/RfpModel.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::MemoryBtf;
using test::valueOf;

constexpr int kWidth = 20;
constexpr int kHeight = 24;

// Uneven, so that sums of floats depend on their order.
MemoryBtf unevenBtfOfSevenViews(int width = kWidth) {
  MemoryBtf btf(width, kHeight, [](int x, int y, glm::vec3 v, glm::vec3 l) {
    const float value = (0.1f * static_cast<float>((13 * x + 7 * y) % 17) + 0.3f * v.x) * l.z;
    return glm::vec3(0.5f + 0.4f * value, 1e-3f + value * value, 0.3f);
  });
  btf.description().views.resize(7);
  return btf;
}

// As `rfp`, with tables that it does not look at.
class MeanModel : public RfpModel {
 public:
  explicit MeanModel(ModelOptions options) : RfpModel(std::move(options), LayerDirections::Views) {}

  std::vector<ModelTable> tables() const override { return {{"mean", {"Y"}, 1, 1}, {"differences", {"Y"}}}; }
  Result<std::shared_ptr<const ReflectanceModel>> bind(std::shared_ptr<const FieldTables>) const override {
    return std::make_shared<const MeanModel>(options());
  }
};

// Two tables: the mean of all texels, then the differences of about every fifth texel from it. A
// texel gets its own mean less both.
class MeanFitter : public FieldFitter {
 public:
  int gatheringPasses() const override { return 2; }

  void gather(int pass, TexelRun& texels, std::vector<double>& ofRow) const override {
    if (pass == 0) ofRow.resize(2);
    for (int i = 0; i < texels.size(); ++i) {
      const float mean = meanOf(texels.fitted(i));
      if (pass == 1) {
        if ((texels.x() + i + 3 * texels.y()) % 5 == 0) ofRow.push_back(mean - mean_);
      } else {
        ofRow[0] += static_cast<double>(mean);
        ofRow[1] += 1.0;
      }
    }
  }

  Result<void> endPass(int pass, std::span<const std::vector<double>> ofRows) override {
    if (pass == 0) {
      const std::vector<double> sum = addedUp(ofRows);
      mean_ = static_cast<float>(sum[0] / sum[1]);
      return {};
    }
    for (const std::vector<double>& row : ofRows)
      for (const double difference : row) differences_.push_back(static_cast<float>(difference));
    return {};
  }

  FieldTables tables() const override {
    FloatImage mean(1, 1, {"Y"});
    mean.at(0, 0, 0) = mean_;
    FloatImage differences(static_cast<int>(differences_.size()), 1, {"Y"});
    std::ranges::copy(differences_, differences.values().begin());
    return {{"mean", mean}, {"differences", differences}};
  }

  void fit(TexelRun& texels, RunParameters& parameters) const override {
    for (int i = 0; i < texels.size(); ++i) {
      std::ranges::fill(parameters.shared(i), 1.0f);
      std::ranges::fill(parameters.layers(i), meanOf(texels.fitted(i)) - mean_ - differences_.back());
    }
  }

 private:
  static float meanOf(const TexelSamples& samples) {
    float sum = 0.0f;
    for (const glm::vec3 sample : samples.linear) sum += luminance(sample);
    return sum / static_cast<float>(samples.linear.size());
  }

  float mean_ = 0.0f;
  std::vector<float> differences_;
};

FitOptions meanOptions(const fs::path& parts = {}) {
  FitOptions options;
  options.model.name = "mean";
  options.models.add({"mean", "Tables.", {ModelOption::color()}, [](ModelOptions given) {
                        return std::make_shared<const MeanModel>(std::move(given));
                      }});
  options.fitters = {};
  options.fitters.add("mean", [](const FitProblem&) -> Result<std::unique_ptr<FieldFitter>> {
    return std::make_unique<MeanFitter>();
  });
  options.precision = Precision::Float;
  options.partsFolder = parts;
  return options;
}

void expectSame(const FitResult& a, const FitResult& b) {
  for (const char* table : {"mean", "differences"})
    EXPECT_TRUE(std::ranges::equal(a.field.tables().at(table).values(), b.field.tables().at(table).values()))
        << table;
  EXPECT_TRUE(std::ranges::equal(a.field.shared().values(), b.field.shared().values()));
  EXPECT_TRUE(std::ranges::equal(a.field.layers().values(), b.field.layers().values()));
  EXPECT_EQ(a.field.description().fitReport, b.field.description().fitReport);
}

TEST(FieldFitter, GathersOverAllTexels) {
  const MemoryBtf source = unevenBtfOfSevenViews();
  double sum = 0.0;
  for (int y = 0; y < kHeight; ++y) {
    SampleRows rows;
    test::requireDone(source.readRows(y, 1, rows));
    for (std::size_t i = 0; i < rows.floats().size(); i += 3)
      sum += luminance(glm::vec3(rows.floats()[i], rows.floats()[i + 1], rows.floats()[i + 2])) /
             static_cast<double>(rows.floats().size() / 3);
  }
  const FitResult fit = valueOf(fitReflectanceField(source, meanOptions()));
  EXPECT_NEAR(fit.field.tables().at("mean").at(0, 0, 0), sum / kHeight, 1e-5);
  EXPECT_EQ(fit.field.tables().at("differences").width(), kWidth * kHeight / 5);
}

TEST(FieldFitter, NeitherThreadsNorBlocksChangeTheResult) {
  const MemoryBtf source = unevenBtfOfSevenViews(450);  // 3.1 MB a row
  const FitResult expected = valueOf(fitReflectanceField(source, meanOptions()));
  for (const int threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    FitOptions options = meanOptions();
    options.memory = std::size_t(threads == 2 ? 100 : 64) << 20;
    tbb::task_arena(threads).execute(
        [&] { expectSame(valueOf(fitReflectanceField(source, options)), expected); });
  }
}

TEST(FieldFitter, ProcessesShareThePasses) {
  const MemoryBtf source = unevenBtfOfSevenViews();
  const fs::path parts = test::testFolder() / "parts";
  FieldFit first = valueOf(FieldFit::create(source, meanOptions(parts)));
  FieldFit second = valueOf(FieldFit::create(source, meanOptions(parts)));
  for (bool more = true; more;) {
    test::requireDone(second.fitRows(11, kHeight - 11, {}));
    if (!first.inLastPass()) {
      EXPECT_FALSE(first.nextPass()) << "rows are missing";
    }
    test::requireDone(first.fitRows(4, 7, {}));
    test::requireDone(first.fitRows(0, 4, {}));
    more = !first.inLastPass();
    if (!more) break;
    test::requireDone(second.nextPass());
    test::requireDone(first.nextPass());
  }
  test::requireDone(first.resume());
  expectSame(valueOf(first.finish()), valueOf(fitReflectanceField(source, meanOptions())));
}

TEST(FieldFitter, AStopInAnyPassLosesNothing) {
  const MemoryBtf source = unevenBtfOfSevenViews();
  const FitResult expected = valueOf(fitReflectanceField(source, meanOptions()));
  for (int stopped = 0; stopped < 3; ++stopped) {
    const fs::path parts = test::testFolder() / ("parts" + std::to_string(stopped));
    {
      FieldFit fit = valueOf(FieldFit::create(source, meanOptions(parts)));
      for (int pass = 0; pass < stopped; ++pass) {
        test::requireDone(fit.fitRows(0, kHeight, {}));
        test::requireDone(fit.nextPass());
      }
      test::requireDone(fit.fitRows(3, 5, {}));
    }
    FieldFit fit = valueOf(FieldFit::create(source, meanOptions(parts)));
    test::requireDone(fit.resume());
    test::fitRemainingPasses(fit);
    expectSame(valueOf(fit.finish()), expected);
    fit.removeParts();
    EXPECT_FALSE(fs::exists(parts));
  }
}

TEST(FieldFitter, ProgressIsThatOfAllPasses) {
  double last = 0.0;
  valueOf(fitReflectanceField(unevenBtfOfSevenViews(), meanOptions(), [&](double fraction) {
    EXPECT_GT(fraction, last);
    last = fraction;
  }));
  EXPECT_DOUBLE_EQ(last, 1.0);
}

}  // namespace
}  // namespace weft
