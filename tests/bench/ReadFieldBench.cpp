// How long a reflectance field file takes to open, to read one view of, to read whole, and to write
// again: read_field_bench FILE.rf.exr [options of Google Benchmark]

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <utility>
#include <vector>

#include "weft/io/ReflectanceFieldFile.h"

namespace {

void open(benchmark::State& state, const char* path) {
  for (auto _ : state) {
    Imf::MultiPartInputFile file(path);
    benchmark::DoNotOptimize(
        file.header(0).typedAttribute<Imf::StringAttribute>("weftReflectanceField").value().size());
  }
}

/// Opens the file and reads the part of its middle view alone.
void readOneView(benchmark::State& state, const char* path) {
  for (auto _ : state) {
    Imf::MultiPartInputFile file(path);
    const int part = file.parts() / 2;
    const Imf::Header& header = file.header(part);
    const Imath::Box2i box = header.dataWindow();
    const std::size_t width = static_cast<std::size_t>(box.max.x) + 1;
    std::vector<std::vector<float>> channels;
    Imf::FrameBuffer buffer;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
      auto& values = channels.emplace_back(width * (static_cast<std::size_t>(box.max.y) + 1));
      buffer.insert(channel.name(), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()),
                                               sizeof(float), sizeof(float) * width));
    }
    Imf::InputPart view(file, part);
    view.setFrameBuffer(buffer);
    view.readPixels(box.min.y, box.max.y);
    benchmark::DoNotOptimize(channels);
  }
}

void readWhole(benchmark::State& state, const char* path) {
  for (auto _ : state) {
    auto field = weft::readReflectanceField(path, weft::ModelRegistry::builtin());
    if (!field) return state.SkipWithError(field.error().message().c_str());
    benchmark::DoNotOptimize(field);
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(std::filesystem::file_size(path)));
}

void writeWhole(benchmark::State& state, const char* path) {
  const auto field = weft::readReflectanceField(path, weft::ModelRegistry::builtin());
  if (!field) return state.SkipWithError(field.error().message().c_str());
  const std::filesystem::path copy = std::string(path) + ".copy";
  for (auto _ : state)
    if (const auto written = weft::writeReflectanceField(*field, copy); !written)
      state.SkipWithError(written.error().message().c_str());
  std::filesystem::remove(copy);
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(std::filesystem::file_size(path)));
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc != 2) {
    std::fprintf(stderr, "read_field_bench FILE.rf.exr [options of Google Benchmark]\n");
    return 1;
  }
  for (const auto& [name, measure] :
       {std::pair("open", &open), std::pair("read one view", &readOneView),
        std::pair("read whole", &readWhole), std::pair("write whole", &writeWhole)})
    benchmark::RegisterBenchmark(name, measure, argv[1])->Unit(benchmark::kMillisecond)->UseRealTime();
  try {
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
