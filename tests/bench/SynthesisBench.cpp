// Times of synthesis beside table 1 of [Bosserhoff 2003], and how visible seams and repetition are
// with each method, of fitted fields: synthesis_bench [--size S] [--periods X Y] NAME.rf.exr...
// --periods: how many periods of ribs or yarns the samples are known to hold, along x and down y.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "weft/io/ReflectanceFieldFile.h"
#include "weft/synthesis/Synthesis.h"
#include "weft/synthesis/SynthesisQuality.h"

namespace {

using namespace weft;

template <class T>
T valueOf(Result<T> result) {
  if (!result) std::fprintf(stderr, "%s\n", result.error().message().c_str()), std::exit(2);
  return std::move(*result);
}

struct Row {
  SynthesisOptions options;
  const char* paper;  // of table 1
};

std::vector<Row> rows() {
  const auto coherent = [](int size, int k, int neighborhood) {
    return SynthesisOptions{.method = SynthesisMethod::KCoherence,
                            .width = size,
                            .height = size,
                            .k = k,
                            .neighborhood = neighborhood};
  };
  return {{coherent(256, 1, 2), "1.9"},
          {coherent(256, 3, 2), "2.7"},
          {coherent(256, 6, 2), "3.7"},
          {coherent(256, 6, 3), "13.6"},
          {coherent(512, 6, 2), "13.4"},
          {{.method = SynthesisMethod::JumpMap, .width = 256, .height = 256}, "-"},
          {{.width = 256, .height = 256}, "-"},
          {{.width = 512, .height = 512}, "-"},
          {{.width = 1024, .height = 1024}, "-"}};
}

void printTimes(const AppearanceSample& sample) {
  fmt::print("| size | method | k | neighbourhood | paper, s | synthesis, s | analysis, s |\n");
  for (const Row& row : rows()) {
    const Synthesis made = valueOf(synthesize(sample, row.options));
    const bool isCoherent = row.options.method == SynthesisMethod::KCoherence;
    fmt::print("| {} | {} | {} | {} | {} | {:.3f} | {:.2f} |\n", row.options.width, name(row.options.method),
               isCoherent ? std::to_string(row.options.k) : "-",
               isCoherent ? std::to_string(row.options.neighborhood) : "-", row.paper, made.synthesisSeconds,
               made.analysisSeconds);
  }
}

/// Neighbours whose phases of what is regular are more than a quarter of a period from what they
/// should be: broken ribs.
int brokenSteps(const CoordinateMap& map, glm::dvec2 periods) {
  const glm::dvec2 wave(periods.x / map.sampleWidth(), periods.y / map.sampleHeight());
  int broken = 0;
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x)
      for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(0, 1)}) {
        const glm::ivec2 next = map.at((x + step.x) % map.width(), (y + step.y) % map.height());
        const double off = glm::dot(wave, glm::dvec2(next - map.at(x, y) - step));
        broken += std::abs(off - std::round(off)) > 0.25;
      }
  return broken;
}

void printQuality(const std::vector<AppearanceSample>& views, const char* method, const CoordinateMap& map,
                  glm::dvec2 periods) {
  fmt::print("| {} |", method);
  for (const AppearanceSample& sample : views) {
    const SeamVisibility seams = seamVisibility(sample, map);
    fmt::print(" {:.2f} {:.2f} {:.2f} |", seams.mean[0], seams.mean[1], seams.mean[2]);
  }
  const Repetition repeated = repetition(views.front(), map);
  fmt::print(" {:.3f} | {:.2f} ({:.2f}) | {:.2f} | {:.2f} | {} |\n", seamVisibility(views.front(), map).jumps,
             repeated.correlation, repeated.ofSample, repeated.beyondSample(), repeated.copied,
             brokenSteps(map, periods));
}

void printQualities(const ReflectanceField& field, int size, glm::dvec2 periods) {
  std::vector<AppearanceSample> views;
  for (const PolarRange range : {PolarRange{0, 90}, PolarRange{0, 15}, PolarRange{60, 90}})
    views.push_back(valueOf(appearanceOf(field, range)));
  for (AppearanceSample& sample : views) sample.repeats = views.front().repeats;
  fmt::print(
      "| method | seams | from the top | 60 degrees and more | jumps | repetition (sample) | beyond | copied "
      "|\n");
  printQuality(views, "tiled", valueOf(tiledMap(size, size, views.front())), periods);
  for (const SynthesisMethod method :
       {SynthesisMethod::JumpMap, SynthesisMethod::KCoherence, SynthesisMethod::Patches})
    printQuality(views, name(method).data(),
                 valueOf(synthesize(views.front(), {.method = method, .width = size, .height = size})).map,
                 periods);
}

}  // namespace

int main(int argc, char** argv) {
  int size = 256;
  glm::dvec2 periods(0.0);
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i)
    if (argv[i] == std::string("--size") && i + 1 < argc)
      size = std::atoi(argv[++i]);
    else if (argv[i] == std::string("--periods") && i + 2 < argc)
      periods = {std::atof(argv[i + 1]), std::atof(argv[i + 2])}, i += 2;
    else
      files.emplace_back(argv[i]);
  if (files.empty())
    return std::fprintf(stderr, "synthesis_bench [--size S] [--periods X Y] NAME.rf.exr...\n"), 1;
  for (const std::string& file : files) {
    const weft::ReflectanceField field = valueOf(weft::readReflectanceField(file));
    const weft::AppearanceSample sample = valueOf(weft::appearanceOf(field));
    fmt::print("\n{}: {} x {} texels, margin {}, {}, {} dimensions keep {:.3f} of the variance\n\n", file,
               field.width(), field.height(), sample.margin, sample.repeats ? "repeats" : "does not repeat",
               sample.vectors.dimensions, sample.keptVariance);
    printTimes(sample);
    fmt::print("\n");
    printQualities(field, size, periods);
  }
}
