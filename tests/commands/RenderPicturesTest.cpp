// Which pictures weft-render draws of a scene, and what stands in them.

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "ConstantField.h"
#include "GltfText.h"
#include "ProgramRun.h"
#include "TestSupport.h"
#include "weft/io/ExrFile.h"
#include "weft/io/ImageFile.h"

namespace weft {
namespace {

class RenderPictures : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name, std::ios::binary) << text;
    return folder / name;
  }

  test::ProgramRun render(const std::string& scene, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{scene, "-o", output, "--size", "40x30"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::runProgram("weft-render", arguments);
  }

  static void expectRefused(const test::ProgramRun& run, int exitCode, const std::string& message) {
    EXPECT_EQ(run.exitCode, exitCode);
    EXPECT_THAT(run.err, testing::HasSubstr(message));
  }

  const std::filesystem::path folder = test::testFolder();
  const std::string output = (folder / "out.png").string();
};

TEST_F(RenderPictures, DrawsAPictureOfEachCamera) {
  std::string scene = test::planeGltf();
  scene = test::replaced(scene, R"("scenes":[{"nodes":[0]}],"nodes":[)",
                         R"("scenes":[{"nodes":[0,1,2,3,4]}],"cameras":[
      {"name":"Front view-2","type":"perspective","perspective":{"yfov":1,"znear":0.1}},
      {"name":"Front view","type":"perspective","perspective":{"yfov":1,"znear":0.1}},
      {"name":"far/off","type":"perspective","perspective":{"yfov":0.2,"znear":0.1}}],"nodes":[)");
  scene = test::replaced(scene, R"("name":"plane"}],)", R"("name":"plane"},{"camera":1,"translation":[0,0,2]},
      {"camera":2,"translation":[0,0,2]},{"camera":1,"translation":[0,0,4]},
      {"camera":0,"translation":[0,0,3]}],)");
  const std::string file = write("scene.gltf", scene).string(), report = (folder / "report.json").string();
  ASSERT_EQ(render(file, {"--camera", "all", "--json", report}).exitCode, 0);
  const auto json = nlohmann::json::parse(std::ifstream(report));
  const auto fileOf = [&](const std::string& name) { return (folder / ("out-" + name + ".png")).string(); };
  EXPECT_EQ(json.at("pictures"), (std::vector{fileOf("Front_view"), fileOf("far_off"), fileOf("Front_view-2"),
                                              fileOf("Front_view-2-2")}));
  EXPECT_FALSE(std::filesystem::exists(output));
  const auto pictureOf = [&](const std::string& path) { return test::valueOf(readImage(path)).bytes; };
  const auto first = pictureOf(fileOf("Front_view")), second = pictureOf(fileOf("far_off"));
  EXPECT_NE(first, second);
  ASSERT_EQ(render(file, {"--camera", "Front view"}).exitCode, 0);
  EXPECT_EQ(pictureOf(output), first);
  expectRefused(render(write("none.gltf", test::planeGltf()).string(), {"--camera", "all"}), 2,
                "there is no camera");
  expectRefused(render(file, {"--camera", "all", "--turntable", "2"}), 1, "--turntable");
}

TEST_F(RenderPictures, LayersStandBesideTheLight) {
  const std::string picture = (folder / "out.exr").string();
  const std::vector<std::string> common{"shape:plane", "--size", "20",   "--camera",
                                        "0,0,3:0,0,0", "-o",     picture};
  const auto drawn = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = common;
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(test::runProgram("weft-render", arguments).exitCode, 0);
    return test::valueOf(readExr(picture));
  };
  const FloatImage plain = drawn({}), all = drawn({"--aov", "normal,depth,albedo,uv"});
  EXPECT_EQ(plain.channelCount(), 4);
  EXPECT_EQ(all.channelCount(), 13);
  const auto value = [&](const FloatImage& image, int x, int y, const char* channel) {
    return image.at(x, y, image.channelIndex(channel).value());
  };
  for (const char* channel : {"R", "G", "B", "A"})
    EXPECT_EQ(value(all, 10, 10, channel), value(plain, 10, 10, channel));
  EXPECT_NEAR(value(all, 10, 10, "depth.Z"), 3.0f, 1e-4f);
  EXPECT_NEAR(value(all, 10, 10, "normal.Z"), 1.0f, 1e-4f);
  EXPECT_NEAR(value(all, 10, 10, "albedo.G"), 1.0f, 1e-3f);
  // Four pixels of a plane that is 3 away, and whose image is 1 wide; cameras see 0.7 radians.
  EXPECT_NEAR(value(all, 12, 10, "uv.U") - value(all, 8, 10, "uv.U"), 4.0 / 20 * 6 * std::tan(0.35), 1e-3);
  EXPECT_EQ(value(all, 0, 0, "depth.Z"), 0.0f) << "nothing is there";
  expectRefused(render("shape:plane", {"--aov", "normal"}), 1, ".exr");
  expectRefused(render("shape:plane", {"--aov", "colour"}), 1, "--aov");
}

TEST_F(RenderPictures, NamesAndFilesMayHoldEquals) {
  test::writeConstantField(folder / "a=b.rf.exr", glm::vec3(0.5f));
  const std::string field = (folder / "a=b.rf.exr").string();
  const std::string scene = write("scene.gltf", test::planeGltf(R"({"name":"seat=1=red"})")).string();
  EXPECT_EQ(render(scene, {"--material", "seat=1=red=" + field, "--uv-scale", "9"}).exitCode, 0);
  EXPECT_EQ(render("shape:plane", {"--material", "*=" + field, "--uv-scale", "9"}).exitCode, 0);
  expectRefused(render(scene, {"--material", "seat=none=1"}), 2, "none=1");
}

}  // namespace
}  // namespace weft
