// Texels a second and core that LafSolver fits, and ceres::TinySolver beside it, which starts next
// to the truth and sees every sample by itself. laf_solver_bench [FILE] [options of Google
// Benchmark]: synthetic texels, and texels of a measured BTF if one is named.

#include <benchmark/benchmark.h>

#include "LafTexels.h"
#include "weft/core/Color.h"
#include "weft/measurement/BtfSource.h"

namespace {

using namespace weft;
using test::LafTexels;

// One row, spread over the material, as `laf` fits it.
Result<LafTexels> measuredTexels(const char* file) {
  WEFT_TRY(const std::unique_ptr<BtfSource> source, openBtf(file));
  const BtfDescription& btf = source->description();
  LafTexels texels;
  texels.problem = {btf.views, btf.lights};
  SampleRows row;
  WEFT_TRY_VOID(source->readRows(btf.height / 2, 1, row));
  std::vector<glm::vec3> samples(row.pairs());
  for (int x = 0; x < btf.width; ++x) {
    row.linear(0, x, samples);
    std::vector<float> targets;
    std::vector<float> scales;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const float value = luminance(samples[i]);
      const float weight = 1.0f / std::sqrt(value + 0.01f);
      targets.push_back(weight * value);
      scales.push_back(weight * btf.lights[i % btf.lights.size()].z);
    }
    texels.targets.push_back(std::move(targets));
    texels.scales.push_back(std::move(scales));
  }
  return texels;
}

void ours(benchmark::State& state, const LafTexels& texels) {
  const LafSolver solver(texels.problem);
  for (auto _ : state) {
    double sum = 0.0;
    for (std::size_t i = 0; i < texels.targets.size(); ++i)
      sum += std::sqrt(solver.fit(texels.job(i), static_cast<int>(state.range(0))).cost);
    state.counters["mean_root_cost"] = sum / static_cast<double>(texels.targets.size());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(texels.targets.size()));
}

void oursFromStarts(benchmark::State& state, const LafTexels& texels) {
  const LafSolver solver(texels.problem);
  for (auto _ : state) {
    double sum = 0.0;
    for (std::size_t i = 0; i < texels.size(); ++i) {
      LafFit fit = texels.starts[i];
      solver.improve(texels.job(i), 50, fit);
      sum += std::sqrt(fit.cost);
    }
    state.counters["mean_root_cost"] = sum / static_cast<double>(texels.size());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(texels.size()));
}

void tinySolver(benchmark::State& state, const LafTexels& texels) {
  for (auto _ : state) {
    double sum = 0.0;
    for (std::size_t i = 0; i < texels.size(); ++i)
      sum += std::sqrt(test::lafCostByReference(texels.problem, texels.job(i), texels.starts[i], 50));
    state.counters["mean_root_cost"] = sum / static_cast<double>(texels.size());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(texels.size()));
}

}  // namespace

int main(int argc, char** argv) {
  const LafTexels synthetic = test::syntheticLafTexels(16, 0.1f, test::ubo2003Sampling());
  benchmark::RegisterBenchmark("synthetic/LafSolver/fromStarts", oursFromStarts, synthetic)
      ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("synthetic/TinySolver/fromStarts", tinySolver, synthetic)
      ->Unit(benchmark::kMillisecond);
  LafTexels measured;
  if (argc > 1 && argv[1][0] != '-') {
    auto texels = measuredTexels(argv[1]);
    if (!texels) return std::fprintf(stderr, "%s\n", texels.error().message().c_str()), 2;
    measured = std::move(*texels);
    benchmark::RegisterBenchmark("measured/LafSolver/lobes", ours, measured)
        ->Arg(2)
        ->Arg(4)
        ->Arg(10)
        ->Unit(benchmark::kMillisecond);
    --argc, ++argv;
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
