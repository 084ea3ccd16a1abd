// Small fits a second and core: solveLobes() beside ceres::TinySolver, same problems and starts,
// each to its own convergence. lobe_solver_bench [FILE] [options of Google Benchmark]: synthetic
// texels, and texels of a measured BTF if one is named.

#include <benchmark/benchmark.h>

#include "LobeTexels.h"
#include "weft/measurement/BtfSource.h"

namespace {

using namespace weft;
using test::LobeTexels;

constexpr std::size_t kFits = 65536;
constexpr int kIterations = 50;

// Texel-views of a measured BTF, each from a broad lobe around the normal and a sharper one towards
// its brightest light.
Result<LobeTexels> measuredTexels(const char* file) {
  WEFT_TRY(const std::unique_ptr<BtfSource> source, openBtf(file));
  const BtfDescription& btf = source->description();
  LobeTexels texels;
  texels.problem.lights = btf.lights;
  for (glm::vec3 light : btf.lights) texels.problem.cosines.push_back(light.z);
  const std::size_t views = btf.views.size();
  const std::size_t lights = btf.lights.size();
  const int rows = static_cast<int>((kFits / views + static_cast<std::size_t>(btf.width) - 1) /
                                    static_cast<std::size_t>(btf.width));
  SampleRows block;
  WEFT_TRY_VOID(source->readRows(0, rows, block));
  std::vector<glm::vec3> samples(lights);
  for (std::size_t fit = 0; fit < kFits; ++fit) {
    const int texel = static_cast<int>(fit / views);
    block.linear(texel / btf.width, texel % btf.width, samples, fit % views * lights);
    std::size_t brightest = 0;
    for (std::size_t i = 0; i < lights; ++i) {
      texels.luminance.push_back(luminance(samples[i]));
      texels.weights.push_back(1.0f / std::sqrt(texels.luminance.back() + 0.01f));
      if (texels.luminance.back() > texels.luminance[fit * lights + brightest]) brightest = i;
    }
    const float peak = texels.luminance[fit * lights + brightest];
    const glm::vec2 p = parabolicFromDirection(btf.lights[brightest]);
    for (float value : {std::sqrt(0.5f * peak), 0.0f, 0.0f, -1.5f, std::sqrt(0.5f * peak), p.x, p.y, 0.0f,
                        std::sqrt(0.2f * peak)})
      texels.parameters.push_back(value);
  }
  return texels;
}

void ours(benchmark::State& state, const LobeTexels& texels) {
  for (auto _ : state) {
    LobeTexels copy = texels;
    std::vector<LobeJob> jobs = copy.jobs();
    solveLobes(copy.problem, copy.lobes, DiffuseSolve::Solve, kIterations, jobs);
    double sum = 0.0;
    for (const LobeJob& job : jobs) sum += std::sqrt(job.cost);
    state.counters["mean_root_cost"] = sum / static_cast<double>(jobs.size());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(texels.size()));
}

void tinySolver(benchmark::State& state, const LobeTexels& texels) {
  constexpr std::size_t fits = 2048;
  for (auto _ : state) {
    LobeTexels copy = texels;
    std::vector<LobeJob> jobs = copy.jobs();
    double sum = 0.0;
    for (std::size_t i = 0; i < fits; ++i) {
      test::solveByReference(copy.problem, jobs[i], kIterations);
      sum += std::sqrt(jobs[i].cost);
    }
    state.counters["mean_root_cost"] = sum / static_cast<double>(fits);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(fits));
}

void registerBoth(const std::string& name, const LobeTexels& texels) {
  benchmark::RegisterBenchmark((name + "/solveLobes").c_str(), ours, texels)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark((name + "/TinySolver").c_str(), tinySolver, texels)
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  registerBoth("synthetic", test::syntheticTexels(kFits));
  if (argc > 1 && argv[1][0] != '-') {
    const auto texels = measuredTexels(argv[1]);
    if (!texels) return std::fprintf(stderr, "%s\n", texels.error().message().c_str()), 2;
    registerBoth("measured", *texels);
    --argc, ++argv;
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
