// How fast a measurement of JPEGs is read, beside the limit: libjpeg-turbo decoding the same bytes
// from memory on the same number of threads, one decoder a thread, into the same place.
// read_btf_bench FILE [THREADS [REPEATS]], FILE being a zip of angle-named JPEGs or an .lp beside
// its JPEGs. Prints MB of decoded pixels a second and the ratio, of the fastest of passes that
// alternate.

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <turbojpeg.h>
#include <zip.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "weft/measurement/BtfSource.h"

namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<unsigned char>;

struct Time {
  double clock = 1e9;
  double processor = 1e9;  ///< of all threads

  void keepFastest(const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t startOfProcessor = std::clock();
    work();
    clock = std::min(clock, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    processor = std::min(processor, static_cast<double>(std::clock() - startOfProcessor) / CLOCKS_PER_SEC);
  }
};

std::vector<Bytes> jpegsOfZip(const fs::path& path) {
  std::vector<Bytes> jpegs;
  zip_t* archive = zip_open(path.c_str(), ZIP_RDONLY, nullptr);
  const zip_int64_t count = archive ? zip_get_num_entries(archive, 0) : 0;
  for (zip_int64_t i = 0; i < count; ++i) {
    zip_stat_t stat;
    zip_stat_index(archive, static_cast<zip_uint64_t>(i), 0, &stat);
    zip_file_t* entry = zip_fopen_index(archive, static_cast<zip_uint64_t>(i), 0);
    Bytes bytes(stat.size);
    if (entry && zip_fread(entry, bytes.data(), bytes.size()) > 0) jpegs.push_back(std::move(bytes));
    if (entry) zip_fclose(entry);
  }
  if (archive) zip_discard(archive);
  return jpegs;
}

std::vector<Bytes> jpegsBeside(const fs::path& list) {
  std::vector<Bytes> jpegs;
  for (const auto& entry : fs::directory_iterator(list.parent_path()))
    if (entry.path().extension() == ".jpg") {
      std::ifstream file(entry.path(), std::ios::binary);
      jpegs.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
  return jpegs;
}

void decodeAll(const std::vector<Bytes>& jpegs, int threads, std::size_t imageBytes) {
  std::atomic<std::size_t> next = 0;
  std::vector<std::jthread> workers;
  for (int i = 0; i < threads; ++i)
    workers.emplace_back([&] {
      const tjhandle decoder = tjInitDecompress();
      Bytes pixels(imageBytes);
      for (std::size_t index; (index = next++) < jpegs.size();) {
        const Bytes& jpeg = jpegs[index];
        int width = 0, height = 0, subsampling = 0, colorSpace = 0;
        tjDecompressHeader3(decoder, jpeg.data(), jpeg.size(), &width, &height, &subsampling, &colorSpace);
        if (static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3 <= imageBytes)
          tjDecompress2(decoder, jpeg.data(), jpeg.size(), pixels.data(), width, 0, height, TJPF_RGB, 0);
      }
      tjDestroy(decoder);
    });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::fprintf(stderr, "read_btf_bench FILE [THREADS [REPEATS]]\n"), 1;
  const fs::path path = argv[1];
  const int threads =
      argc > 2 ? std::max(std::atoi(argv[2]), 1) : static_cast<int>(std::thread::hardware_concurrency());
  const int repeats = argc > 3 ? std::max(std::atoi(argv[3]), 1) : 3;
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  const auto source = weft::openBtf(path);
  if (!source) return std::fprintf(stderr, "%s\n", source.error().message().c_str()), 2;
  const weft::BtfDescription& btf = (*source)->description();
  const std::vector<Bytes> jpegs = path.extension() == ".lp" ? jpegsBeside(path) : jpegsOfZip(path);
  if (jpegs.size() != btf.views.size() * btf.lights.size())
    return std::fprintf(stderr, "%s: there are other files than its JPEGs\n", path.c_str()), 2;

  const double megabytes = static_cast<double>(btf.rowBytes()) * btf.height / 1e6;
  Time read;
  Time decode;
  weft::SampleRows rows;
  for (int i = 0; i < repeats; ++i) {
    read.keepFastest([&] {
      if (const auto result = (*source)->readRows(0, btf.height, rows); !result)
        std::fprintf(stderr, "%s\n", result.error().message().c_str()), std::exit(2);
    });
    decode.keepFastest([&] { decodeAll(jpegs, threads, btf.texels() * 3); });
  }
  fmt::print("{}: {} JPEGs of {} x {}, {} threads\n", btf.name, jpegs.size(), btf.width, btf.height, threads);
  for (const auto& [name, time] : {std::pair("readRows", read), std::pair("libjpeg-turbo", decode)})
    fmt::print("{:15} {:8.3f} s {:8.0f} MB/s, {:8.3f} s of the processor\n", name, time.clock,
               megabytes / time.clock, time.processor);
  fmt::print("ratio           {:8.2f}   of the processor's time {:.2f}\n", decode.clock / read.clock,
             decode.processor / read.processor);
}
