// Fits that are stopped, shared, or tested on what they have not seen.
#include <gmock/gmock.h>

#include <tbb/global_control.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>

#include "FitPasses.h"
#include "MemoryBtf.h"
#include "TestSupport.h"
#include "weft/fitter/FieldFit.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::MemoryBtf;
using test::valueOf;
using testing::HasSubstr;

constexpr int kRows = 40;  // two rows a part

MemoryBtf unevenBtf() {
  return MemoryBtf(3, kRows, [](int x, int y, glm::vec3 v, glm::vec3 l) {
    return glm::vec3(0.9f, 0.6f, 0.3f) * l.z *
           (0.5f + 0.3f * std::sin(static_cast<float>(x + 3 * y)) * l.x * v.y);
  });
}

FitOptions optionsWith(const fs::path& parts) {
  FitOptions options;
  options.model.name = "rfp";
  options.partsFolder = parts;
  return options;
}

void expectSameFields(const FitResult& a, const FitResult& b) {
  ASSERT_EQ(a.field.levels().size(), b.field.levels().size());
  for (std::size_t i = 0; i < a.field.levels().size(); ++i) {
    const FieldLevel &ofA = a.field.levels()[i], &ofB = b.field.levels()[i];
    EXPECT_TRUE(std::ranges::equal(ofA.shared.values(), ofB.shared.values())) << "level " << i;
    EXPECT_TRUE(std::ranges::equal(ofA.layers.values(), ofB.layers.values())) << "level " << i;
  }
  EXPECT_EQ(a.field.description().fitReport, b.field.description().fitReport);
}

std::string failureText(const Result<void>& result) {
  return result ? std::string() : result.error().message();
}

// In each pass: that of the finest level, and those of coarser ones.
TEST(FieldFitSteps, AStoppedFitGoesOnToTheSameResult) {
  const MemoryBtf source = unevenBtf();
  const FitResult uninterrupted = valueOf(fitReflectanceField(source, optionsWith({})));
  ASSERT_EQ(uninterrupted.field.levels().size(), 6u);  // 40 20 10 5 2 1 rows
  for (int stoppedPass = 0; stoppedPass < 3; ++stoppedPass) {
    const fs::path parts = test::testFolder() / ("parts" + std::to_string(stoppedPass));
    {
      FieldFit stopped = valueOf(FieldFit::create(source, optionsWith(parts)));
      for (int pass = 0; pass < stoppedPass; ++pass) {
        ASSERT_TRUE(stopped.fitRows(0, stopped.height(), {}));
        ASSERT_TRUE(stopped.nextPass());
      }
      EXPECT_TRUE(stopped.fitRows(3, 5, {}));
    }
    FieldFit resumed = valueOf(FieldFit::create(source, optionsWith(parts)));
    ASSERT_TRUE(resumed.resume());
    test::fitRemainingPasses(resumed);
    expectSameFields(valueOf(resumed.finish()), uninterrupted);
    resumed.removeParts();
    EXPECT_FALSE(fs::exists(parts));
  }
}

TEST(FieldFitSteps, ProcessesShareAFitByItsFolder) {
  const MemoryBtf source = unevenBtf();
  const fs::path parts = test::testFolder() / "parts";
  std::vector<FieldFit> processes;
  for (int rank = 0; rank < 3; ++rank) {
    FieldFit fit = valueOf(FieldFit::create(source, optionsWith(parts)));
    for (bool more = true; more;) {
      const int first = fit.height() * rank / 3;
      EXPECT_TRUE(fit.fitRows(first, fit.height() * (rank + 1) / 3 - first, {}));
      more = !fit.inLastPass();
      if (more) test::requireDone(fit.nextPass());
    }
    processes.push_back(std::move(fit));
  }
  EXPECT_FALSE(processes[1].finish()) << "rows are missing";
  ASSERT_TRUE(processes[0].resume());
  expectSameFields(valueOf(processes[0].finish()), valueOf(fitReflectanceField(source, optionsWith({}))));
}

TEST(FieldFitSteps, RowsOfAnotherFitAreRefused) {
  const MemoryBtf source = unevenBtf();
  FitOptions options = optionsWith(test::testFolder() / "parts");
  FieldFit fit = valueOf(FieldFit::create(source, options));
  ASSERT_TRUE(fit.fitRows(0, 2, {}));
  options.model.options["color"] = "rgb";
  EXPECT_THAT(failureText(valueOf(FieldFit::create(source, options)).resume()), HasSubstr("another fit"));
  options = optionsWith(options.partsFolder);
  options.crop = Crop{0, 0, 3, 8};
  EXPECT_THAT(failureText(valueOf(FieldFit::create(source, options)).resume()), HasSubstr("another fit"));
}

// Another measurement of the same shape and name, and the same one under another name.
TEST(FieldFitSteps, MeasurementsAreToldApartByWhatWasMeasured) {
  const FitOptions options = optionsWith(test::testFolder() / "parts");
  MemoryBtf source = unevenBtf();
  FieldFit fit = valueOf(FieldFit::create(source, options));
  ASSERT_TRUE(fit.fitRows(0, 2, {}));
  source.description().name = "renamed";
  EXPECT_TRUE(valueOf(FieldFit::create(source, options)).resume());
  source.description().views[7] = directionFromDegrees(31, 0.01);
  EXPECT_THAT(failureText(valueOf(FieldFit::create(source, options)).resume()), HasSubstr("another fit"));
  const MemoryBtf other(3, kRows, [](int x, int y, glm::vec3, glm::vec3 l) {
    return glm::vec3(x == 2 && y == kRows - 1 ? 0.5f : 0.4f) * l.z;
  });
  EXPECT_THAT(failureText(valueOf(FieldFit::create(other, options)).resume()), HasSubstr("another fit"));
}

int rowFilesIn(const fs::path& folder) {
  int files = 0;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing))
    if (entry.path().extension() == ".rows") ++files;
  return files;
}

// The only thread waits in the middle of the fit for the rows before it.
TEST(FieldFitSteps, OneThreadKeepsItsRowsToo) {
  const MemoryBtf source = unevenBtf();
  const FitOptions options = optionsWith(test::testFolder() / "parts");
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  FieldFit fit = valueOf(FieldFit::create(source, options));
  bool kept = false;
  ASSERT_TRUE(fit.fitRows(0, kRows, [&](double fraction) {
    if (fraction < 0.5 || fraction == 1.0 || kept) return;
    for (int i = 0; i < 1000 && rowFilesIn(options.partsFolder) == 0; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    kept = rowFilesIn(options.partsFolder) > 0;
  }));
  EXPECT_TRUE(kept);
}

// A file is where the folder is to be, until the middle of the fit.
TEST(FieldFitSteps, RowsThatCannotBeKeptAreAWarningAndAreTriedAgain) {
  const MemoryBtf source = unevenBtf();
  FitOptions options = optionsWith(test::testFolder() / "parts");
  std::ofstream(options.partsFolder) << "in the way";
  options.secondsBetweenSaves = 1e-3;
  std::vector<std::string> warnings;
  options.warn = [&](const std::string& warning) { warnings.push_back(warning); };
  FieldFit fit = valueOf(FieldFit::create(source, options));
  ASSERT_TRUE(fit.fitRows(0, kRows, [&](double fraction) {
    if (fraction <= 0.5)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));  // several saves
    else if (fs::is_regular_file(options.partsFolder))
      fs::remove(options.partsFolder);
    else
      for (int i = 0; i < 1000 && rowFilesIn(options.partsFolder) == 0; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }));
  test::fitRemainingPasses(fit);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr(options.partsFolder.string()));
  EXPECT_GT(rowFilesIn(options.partsFolder), 0);
  expectSameFields(valueOf(fit.finish()), valueOf(fitReflectanceField(source, optionsWith({}))));
}

// Processes that share a fit need each other's rows.
TEST(FieldFitSteps, RowsThatOthersWaitForMustBeKept) {
  const MemoryBtf source = unevenBtf();
  const FitOptions options = optionsWith(test::testFolder() / "parts");
  std::ofstream(options.partsFolder) << "in the way";
  EXPECT_THAT(failureText(valueOf(FieldFit::create(source, options)).fitRows(0, 2, {})),
              HasSubstr(options.partsFolder.string()));
}

TEST(FieldFitSteps, APartsFolderHasOneOwnerWhoRemovesItsOwnFilesAlone) {
  const MemoryBtf source = unevenBtf();
  const FitOptions options = optionsWith(test::testFolder() / "parts");
  {
    FieldFit fit = valueOf(FieldFit::create(source, options));
    ASSERT_TRUE(fit.claimParts());
    FieldFit second = valueOf(FieldFit::create(source, options));
    EXPECT_THAT(failureText(second.claimParts()), HasSubstr("another fit"));
    ASSERT_TRUE(fit.fitRows(0, 4, {}));
  }
  EXPECT_GT(rowFilesIn(options.partsFolder), 0) << "for a resume";
  FieldFit fit = valueOf(FieldFit::create(source, options));
  ASSERT_TRUE(fit.claimParts()) << "its owner is gone";
  for (const char* name : {"notes.txt", "mine.rows", "0-000001.rows"})
    std::ofstream(options.partsFolder / name) << "mine";
  fit.removeParts();
  EXPECT_EQ(rowFilesIn(options.partsFolder), 2) << "those of other names";
  EXPECT_TRUE(fs::exists(options.partsFolder / "notes.txt"));
}

TEST(FieldFitSteps, AnEmptyPartsFolderGoesWithItsOwner) {
  const MemoryBtf source = unevenBtf();
  const FitOptions options = optionsWith(test::testFolder() / "parts");
  {
    FieldFit fit = valueOf(FieldFit::create(source, options));
    ASSERT_TRUE(fit.claimParts());
    EXPECT_TRUE(fs::exists(options.partsFolder));
  }
  EXPECT_FALSE(fs::exists(options.partsFolder));
}

TEST(FieldFitSteps, DamagedRowsAreRefused) {
  MemoryBtf source = unevenBtf();
  source.description().views.resize(7);  // each create() looks at all that was measured
  const FitOptions options = optionsWith(test::testFolder() / "parts");
  {
    FieldFit fit = valueOf(FieldFit::create(source, options));
    ASSERT_TRUE(fit.fitRows(0, 2, {}));
  }
  const fs::path file = fs::directory_iterator(options.partsFolder)->path();
  std::ifstream stream(file, std::ios::binary);
  const std::string good(std::istreambuf_iterator<char>(stream), {});
  const auto resumeWith = [&](const std::string& contents) {
    std::ofstream(file, std::ios::binary) << contents;
    return failureText(valueOf(FieldFit::create(source, options)).resume());
  };
  EXPECT_EQ(resumeWith(good), "");
  for (std::size_t size = 0; size < good.size(); size += size < 300 ? 1 : 997)
    EXPECT_THAT(resumeWith(good.substr(0, size)), HasSubstr(file.filename())) << size;
  EXPECT_THAT(resumeWith(good + "x"), HasSubstr("size"));
  // The header first, byte by byte; then the rows, which the checksum guards.
  for (std::size_t at = 0; at < good.size(); at += at < 300 ? 1 : 997) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x55);
    EXPECT_NE(resumeWith(bad), "") << at;
  }
}

TEST(FieldFitSteps, HeldOutPairsAreNotFittedButReported) {
  // The lights that are held out show a value of their own, which the fit cannot know.
  const std::vector<glm::vec3> lights = test::ubo2003Sampling();
  MemoryBtf plain(1, 1, [](int, int, glm::vec3, glm::vec3 l) { return glm::vec3(0.5f * l.z); });
  FitOptions options = optionsWith({});
  options.holdOutLights = 8;
  options.holdOutViews = 10;
  const FitResult clean = valueOf(fitReflectanceField(plain, options));
  const ReflectanceFieldDescription& fitted = clean.field.description();
  EXPECT_EQ(fitted.lights.size(), 71u);
  EXPECT_EQ(fitted.views.size(), 73u);
  EXPECT_EQ(clean.field.layers().layers(), 73);
  const auto isFitted = [&](glm::vec3 light) {
    return std::ranges::find(fitted.lights, light) != fitted.lights.end();
  };

  const MemoryBtf odd(
      1, 1, [&](int, int, glm::vec3, glm::vec3 l) { return glm::vec3(isFitted(l) ? 0.5f * l.z : 0.9f); });
  const FitResult fit = valueOf(fitReflectanceField(odd, options));
  EXPECT_LT(fit.errors.of(ErrorSpace::Linear, ErrorMeasure::Luminance).average, 1e-3);
  ASSERT_TRUE(fit.heldOut);
  EXPECT_GT(fit.heldOut->of(ErrorSpace::Linear, ErrorMeasure::Luminance).average, 0.1);
  EXPECT_TRUE(std::ranges::equal(fit.field.layers().values(), clean.field.layers().values()));
  EXPECT_EQ(clean.texels[0].fitted.pairs, 71u * 73u);
  EXPECT_EQ(clean.texels[0].heldOut.pairs, 81u * 81u - 71u * 73u);
  // Held-out views lie between fitted ones, where a constant is interpolated exactly.
  EXPECT_LT(clean.heldOut->of(ErrorSpace::Linear, ErrorMeasure::Luminance).average, 1e-3);
  options.holdOutLights = 1;
  EXPECT_FALSE(fitReflectanceField(plain, options));
}

}  // namespace
}  // namespace weft
