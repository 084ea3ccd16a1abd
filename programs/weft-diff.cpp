#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "weft/core/FlipDifference.h"
#include "weft/core/ImageComparison.h"
#include "weft/core/StructuralSimilarity.h"
#include "weft/io/ExrFile.h"
#include "weft/io/ImageFile.h"
#include "weft/io/PictureFile.h"
#include "weft/tool/Tool.h"

namespace {

using namespace weft;
using Json = nlohmann::ordered_json;

struct Arguments {
  std::array<std::filesystem::path, 2> files;
  std::string metric;
  std::optional<double> max;
  std::optional<double> mean;
  double pixelsPerDegree = kFlipPixelsPerDegree;
  std::filesystem::path output;
};

/// Two pictures of one size.
struct Pair {
  std::array<FloatImage, 2> values;  ///< as they are compared
  bool linear = false;
  std::array<FloatImage, 2> shown;           ///< as a screen shows them: sRGB, 0 to 1
  std::array<std::size_t, 2> notFinite{};    ///< pixels
  std::vector<std::size_t> differNotFinite;  ///< those of them in which the pictures are not the same
};

/// What one metric says.
struct Measure {
  std::string name;
  FloatImage errors;  ///< 0 where the pictures are alike
  double max = 0.0;   ///< of the errors
  double mean = 0.0;
  Json json;
  std::string text;
};

bool isFinite(std::span<const float> texel) {
  return std::ranges::all_of(texel, [](float value) { return std::isfinite(value); });
}

/// A linear picture as a screen shows it; NaN is black.
FloatImage displayed(FloatImage picture) {
  for (float& value : picture.values())
    value = value > 0.0f ? encode(Encoding::Srgb, std::min(value, 1.0f)) : 0.0f;
  return picture;
}

void tellWhatIsNotShown(const Tool& tool, const std::filesystem::path& file, const FloatImage& linear) {
  const auto values = linear.values();
  const auto outside =
      std::ranges::count_if(values, [](float value) { return value < 0.0f || value > 1.0f; });
  if (outside > 0)
    tool.warn(fmt::format(
        "{}: {:.2g} % of its values are below 0 or above 1, and are compared as a screen "
        "shows them",
        file.string(), 100.0 * static_cast<double>(outside) / static_cast<double>(values.size())));
}

void findNotFinite(const Tool& tool, const Arguments& arguments, Pair& pair) {
  const auto& [a, b] = pair.values;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const bool finite[] = {isFinite(a.texel(x, y)), isFinite(b.texel(x, y))};
      for (std::size_t i = 0; i < 2; ++i) pair.notFinite[i] += finite[i] ? 0 : 1;
      if ((!finite[0] || !finite[1]) && !std::ranges::equal(a.texel(x, y), b.texel(x, y)))
        pair.differNotFinite.push_back(static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width()) +
                                       static_cast<std::size_t>(x));
    }
  for (std::size_t i = 0; i < 2; ++i)
    if (pair.notFinite[i] > 0)
      tool.warn(fmt::format("{}: {} of its pixels are infinite or not a number", arguments.files[i].string(),
                            pair.notFinite[i]));
}

Result<Pair> readPair(const Tool& tool, const Arguments& arguments) {
  std::array<Picture, 2> pictures;
  for (std::size_t i = 0; i < 2; ++i) {
    std::vector<std::string> warnings;
    WEFT_TRY(pictures[i], readPicture(arguments.files[i], warnings));
    for (const std::string& warning : warnings) tool.warn(arguments.files[i].string() + ": " + warning);
  }
  const FloatImage &a = pictures[0].image, &b = pictures[1].image;
  if (a.width() != b.width() || a.height() != b.height())
    return fail(fmt::format("it has {} x {} pixels, {} has {} x {}", b.width(), b.height(),
                            arguments.files[0].string(), a.width(), a.height()),
                arguments.files[1].string(), "pictures of one size are compared");
  Pair pair;
  pair.linear = pictures[0].encoding == Encoding::Linear && pictures[1].encoding == Encoding::Linear;
  for (std::size_t i = 0; i < 2; ++i) pair.values[i] = pictures[i].image;
  findNotFinite(tool, arguments, pair);
  for (std::size_t i = 0; i < 2; ++i) {
    const bool encoded = pictures[i].encoding == Encoding::Srgb;
    pair.shown[i] = encoded ? pair.values[i] : displayed(pair.values[i]);
    if (!encoded && !(pair.linear && arguments.metric == "difference"))
      tellWhatIsNotShown(tool, arguments.files[i], pair.values[i]);
    if (!pair.linear) pair.values[i] = pair.shown[i];
  }
  return pair;
}

Measure differenceOf(const Pair& pair) {
  const auto& [a, b] = pair.values;
  Measure measure{"difference", differenceImage(a, b), 0.0, 0.0, {}, {}};
  const ImageComparison compared = compareImages(a, b);
  measure.max = compared.maximum;
  measure.mean = compared.mean;
  const double psnr = -20.0 * std::log10(compared.rootMeanSquare);
  measure.json = {
      {"max", measure.max}, {"mean", measure.mean}, {"rmse", compared.rootMeanSquare}, {"psnr", psnr}};
  measure.text = fmt::format("max {:.4g}, mean {:.4g}, rmse {:.4g}, psnr {:.4g} dB", measure.max,
                             measure.mean, compared.rootMeanSquare, psnr);
  return measure;
}

/// Pixels that are no colours are as wrong as can be. `margin`: what the errors lack at each side.
void addNotFinite(Measure& measure, const Pair& pair, int margin) {
  const auto width = static_cast<std::size_t>(pair.values[0].width());
  for (const std::size_t pixel : pair.differNotFinite) {
    const int x = static_cast<int>(pixel % width) - margin, y = static_cast<int>(pixel / width) - margin;
    if (x >= 0 && y >= 0 && x < measure.errors.width() && y < measure.errors.height())
      measure.errors.at(x, y, 0) = 1.0f;
  }
  const auto errors = measure.errors.values();
  measure.max = *std::ranges::max_element(errors);
  measure.mean = std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
}

Measure similarityOf(const Pair& pair) {
  Measure measure{"ssim", structuralSimilarity(pair.shown[0], pair.shown[1]), 0.0, 0.0, {}, {}};
  for (float& value : measure.errors.values()) value = 1.0f - value;
  addNotFinite(measure, pair, kSimilarityWindow / 2);
  measure.json = {{"mean", 1.0 - measure.mean}, {"min", 1.0 - measure.max}};
  measure.text = fmt::format("mean {:.6g}, min {:.4g} (1: alike)", 1.0 - measure.mean, 1.0 - measure.max);
  return measure;
}

Measure flipOf(const Pair& pair, double pixelsPerDegree) {
  Measure measure{"flip", flipDifference(pair.shown[0], pair.shown[1], pixelsPerDegree), 0.0, 0.0, {}, {}};
  addNotFinite(measure, pair, 0);
  measure.json = {{"max", measure.max}, {"mean", measure.mean}, {"pixels_per_degree", pixelsPerDegree}};
  measure.text = fmt::format("mean {:.4g}, max {:.4g}", measure.mean, measure.max);
  return measure;
}

/// All that were asked for; that of the bounds first.
Result<std::vector<Measure>> measuresOf(const Tool& tool, const Arguments& arguments, const Pair& pair) {
  const auto wanted = [&](const char* name) { return arguments.metric.empty() || arguments.metric == name; };
  std::vector<Measure> measures;
  if (wanted("difference")) measures.push_back(differenceOf(pair));
  if (wanted("ssim")) {
    const bool fits = std::min(pair.shown[0].width(), pair.shown[0].height()) >= kSimilarityWindow;
    const std::string small =
        fmt::format("ssim compares windows of {0} x {0} pixels; the pictures are smaller", kSimilarityWindow);
    if (!fits && !arguments.metric.empty()) return fail(small, arguments.files[0].string());
    if (fits)
      measures.push_back(similarityOf(pair));
    else
      tool.warn(small);
  }
  if (wanted("flip")) measures.push_back(flipOf(pair, arguments.pixelsPerDegree));
  return measures;
}

Result<void> writeErrors(const std::filesystem::path& path, const FloatImage& errors) {
  FloatImage picture(errors.width(), errors.height(), {"R", "G", "B"});
  const auto channels = static_cast<std::size_t>(errors.channelCount());
  for (std::size_t i = 0; i < picture.values().size(); ++i)
    picture.values()[i] = errors.values()[channels == 3 ? i : i / 3];
  return path.extension() == ".png" ? writePng(path, picture) : writeExr(path, picture);
}

/// Whether a bound holds; tells where it does not.
bool holds(const Tool& tool, const Measure& measure, const char* name, double error,
           const std::optional<double>& bound) {
  if (!bound || error <= *bound) return true;
  const std::string what = measure.name == "ssim" ? "1 - ssim" : measure.name;
  tool.warn(fmt::format("the {} of {}, {:.6g}, is above --{} {:.6g}", name, what, error, name, *bound));
  return false;
}

Result<ExitCode> compare(const Tool& tool, const Arguments& arguments) {
  if (!arguments.output.empty() && arguments.output.extension() != ".png" &&
      arguments.output.extension() != ".exr")
    return tool.badUsage("-o must end with .png or .exr");
  WEFT_TRY(const Pair pair, readPair(tool, arguments));
  WEFT_TRY(const std::vector<Measure> measures, measuresOf(tool, arguments, pair));
  const Measure& bounded = measures.front();
  if (!arguments.output.empty()) WEFT_TRY_VOID(writeErrors(arguments.output, bounded.errors));
  const bool isMaxMet = holds(tool, bounded, "max", bounded.max, arguments.max);
  const bool isMet = holds(tool, bounded, "mean", bounded.mean, arguments.mean) && isMaxMet;

  const int width = pair.values[0].width(), height = pair.values[0].height();
  Json json{{"a", arguments.files[0].string()},
            {"b", arguments.files[1].string()},
            {"width", width},
            {"height", height},
            {"values", pair.linear ? "linear" : "srgb"},
            {"not_finite", pair.notFinite},
            {"within_bounds", isMet}};
  tool.print(fmt::format("{} x {} pixels, {} values\n", width, height, pair.linear ? "linear" : "sRGB"));
  for (const Measure& measure : measures) {
    json[measure.name] = measure.json;
    tool.print(fmt::format("{:<11} {}\n", measure.name, measure.text));
  }
  WEFT_TRY_VOID(tool.writeJson(json));
  return isMet ? ExitCode::Done : ExitCode::BoundMissed;
}

void addOptions(Tool& tool, Arguments& a) {
  CLI::App& app = tool.options();
  app.add_option(
         "A", a.files[0],
         "a picture: PNG, JPEG, OpenEXR or Radiance. Two linear ones (OpenEXR, Radiance) are "
         "compared by their values, others as a screen shows them, 0 to 1; transparency counts as black")
      ->required();
  app.add_option("B", a.files[1], "another one, of the same size")->required();
  app.add_option(
         "--metric", a.metric,
         "difference: absolute, of each channel, with rmse and psnr (of a peak of 1); ssim [Wang 2004], of "
         "luminance; flip [Andersson 2020]. Default: all are told, the bounds and -o are those of difference")
      ->check(CLI::IsMember({"difference", "ssim", "flip"}));
  app.add_option("--max", a.max,
                 "exit with 3 where the largest error of the metric is above this; of ssim, 1 - ssim")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--mean", a.mean, "exit with 3 where its mean is above this")->check(CLI::NonNegativeNumber);
  app.add_option("--pixels-per-degree", a.pixelsPerDegree,
                 "of flip: how many pixels a degree of what the eye sees has")
      ->check(CLI::Range(1.0, 1000.0))
      ->capture_default_str();
  tool.addOutput("-o,--output", a.output,
                 "the errors as a picture: .png (brighter than they are: as light) or .exr (their values)");
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"weft-diff", "Says how much two pictures differ.",
             "weft-diff cloth.png reference.png --metric flip --mean 0.02 -o difference.png"});
  Arguments arguments;
  addOptions(tool, arguments);
  return tool.run(argc, argv, [&] { return compare(tool, arguments); });
}
