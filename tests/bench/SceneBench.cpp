#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <epoxy/gl.h>
#include <malloc.h>
#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

#include "OsgScene.h"
#include "SceneGrid.h"
#include "WeftScene.h"

// Weft and OpenSceneGraph draw the same scenes in turns, so that both see the same load of the
// machine.

namespace weft::bench {

FrameTime timed(bool discard, const std::function<void()>& draw) {
  (discard ? glEnable : glDisable)(GL_RASTERIZER_DISCARD);
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t processorStart = std::clock();
  draw();
  glFinish();
  const auto processor = static_cast<double>(std::clock() - processorStart) / (CLOCKS_PER_SEC / 1000);
  const std::chrono::duration<double, std::milli> clock = std::chrono::steady_clock::now() - start;
  glDisable(GL_RASTERIZER_DISCARD);
  return {clock.count(), processor};
}

namespace {

constexpr int kFramesARound = 5;

double median(std::vector<double> times) {
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  return times[times.size() / 2];
}

struct Times {
  std::vector<double> clock, processor;

  void add(FrameTime time) {
    clock.push_back(time.clock);
    processor.push_back(time.processor);
  }
};

/// Rounds of a few frames of each side.
std::pair<Times, Times> inTurns(int rounds, Side& weft, Side& osg, bool discard) {
  std::pair<Times, Times> times;
  for (int round = 0; round < rounds; ++round)
    for (const auto& [side, own] : {std::pair{&weft, &times.first}, std::pair{&osg, &times.second}}) {
      side->makeCurrent();
      side->frame(discard);  // what switching contexts costs is nobody's
      for (int frame = 0; frame < kFramesARound; ++frame) own->add(side->frame(discard));
    }
  return times;
}

void report(const std::string& what, const std::pair<Times, Times>& times, double bound) {
  fmt::print("{:<44}", what);
  for (const auto part : {&Times::clock, &Times::processor}) {
    const double weft = median(times.first.*part), osg = median(times.second.*part);
    fmt::print(" {:8.2f} {:8.2f} {:7.2f}  ", weft, osg, weft / osg);
  }
  fmt::print(" {}\n", bound);
}

/// The mean difference of the two pictures, which must be small for the times to mean anything.
double difference(Side& weft, Side& osg) {
  const std::vector<float> a = weft.picture(), b = osg.picture();
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(double(a[i]) - double(b[i]));
  return sum / static_cast<double>(a.size());
}

int run(int rounds, const std::string& only) {
  fmt::print("milliseconds, medians of {} frames, {} x {}, {} boxes, {} materials\n", kFramesARound * rounds,
             SceneGrid::kPicture, SceneGrid::kPicture, SceneGrid::kSide * SceneGrid::kSide,
             SceneGrid::kMaterials);
  fmt::print("{:<44} {:^26} {:^26}\n", "", "by the clock", "of the processor");
  fmt::print("{:<44}", "");
  for (int i = 0; i < 2; ++i) fmt::print(" {:>8} {:>8} {:>7}  ", "Weft", "OSG", "ratio");
  fmt::print(" at most\n");
  for (const bool shared : {true, false}) {
    const SceneGrid grid(shared);
    const auto weft = makeWeftScene(grid);
    const auto osg = makeOsgScene(grid);
    const std::string name = shared ? "one shared box" : "10,000 different meshes";
    for (const bool all : {true, false}) {
      weft->look(all);
      osg->look(all);
      const std::string place = name + (all ? ", all visible: " : ", few visible: ");
      const double mean = difference(*weft, *osg);
      if (!(mean < 0.01)) {
        fmt::print(stderr, "{} the pictures differ by {} on average\n", place, mean);
        return 1;
      }
      const auto measure = [&](const std::string& what, bool discard, double bound) {
        if ((place + what).find(only) != std::string::npos)
          report(place + what, inTurns(rounds, *weft, *osg, discard), bound);
      };
      measure("frame", false, all ? 0.8 : 1.0);
      if (all) measure("submission", true, shared ? 0.55 : 0.65);
    }
    weft->explain();
  }
  return 0;
}

}  // namespace
}  // namespace weft::bench

int main(int argc, char** argv) {
  CLI::App app("Times frames of Weft and of OpenSceneGraph on the same scenes.");
  int rounds = 8;
  app.add_option("--rounds", rounds, "of 5 frames for each side")->capture_default_str();
  std::string only;
  app.add_option("--only", only, "measures only lines that contain this text");
  CLI11_PARSE(app, argc, argv);
  // Once a process has freed some large block, as any that loads pictures, glibc no longer hands
  // what llvmpipe frees after a frame back to the system. Without, it depends on the layout of the
  // heap which side pays for that.
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
  return weft::bench::run(rounds, only);
}
