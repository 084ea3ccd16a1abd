#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "ConstantField.h"
#include "GltfText.h"
#include "OlderFields.h"
#include "ProgramRun.h"
#include "TestSupport.h"
#include "weft/core/ImageComparison.h"
#include "weft/io/ExrFile.h"
#include "weft/io/ImageFile.h"
#include "weft/io/ReflectanceFieldFile.h"

namespace weft {
namespace {

using test::ProgramRun;
using testing::HasSubstr;

class RenderCommand : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name, std::ios::binary) << text;
    return folder / name;
  }

  /// Renders 40 x 30 pixels of a scene.
  ProgramRun render(const std::string& scene, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{scene, "-o", output, "--size", "40x30"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::runProgram("weft-render", arguments);
  }

  void expectBadInput(const ProgramRun& run, const std::string& message) const {
    EXPECT_EQ(run.exitCode, 2);
    EXPECT_THAT(run.err, HasSubstr(message));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    expectNoOutput();
  }

  void expectBadUsage(const ProgramRun& run, const std::string& message) const {
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_THAT(run.err, HasSubstr(message));
    expectNoOutput();
  }

  void expectNoOutput() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      EXPECT_THAT(entry.path().filename().string(), testing::Not(testing::StartsWith("out"))) << entry.path();
  }

  const std::filesystem::path folder = test::testFolder();
  const std::string output = (folder / "out.png").string();
};

TEST_F(RenderCommand, FieldsOfOlderFilesLookAsTheyDidThen) {
  for (const std::string& name : test::olderFields()) {
    const std::filesystem::path field = test::olderFieldsFolder() / name, picture = folder / "picture.exr";
    ASSERT_EQ(test::runProgram("weft-render",
                               {"shape:plane", "--material", "*=" + field.string() + ".rf.exr", "--camera",
                                "0.3,0.4,1:0,0,0", "--light=-1,1,1.5", "--size", "10x8", "-o", picture})
                  .exitCode,
              0);
    const FloatImage then = test::valueOf(readExr(field.string() + ".picture.exr"));
    EXPECT_LE(compareImages(test::valueOf(readExr(picture)), then).maximum, 1e-6f) << name;
  }
}

// The first picture is that without a turntable, the second shows the other side.
TEST_F(RenderCommand, ATurntableShowsTheSceneFromAllSides) {
  ASSERT_EQ(render("shape:cloth", {"--turntable", "2", "--camera", "1,2,3:0,0,0"}).exitCode, 0);
  ASSERT_EQ(render("shape:cloth", {"--camera", "1,2,3:0,0,0"}).exitCode, 0);
  const auto picture = [&](const char* name) { return test::valueOf(readImage(folder / name)).bytes; };
  EXPECT_EQ(picture("out-000.png"), picture("out.png"));
  EXPECT_NE(picture("out-001.png"), picture("out.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out-002.png"));
}

TEST_F(RenderCommand, DrawsTheBuiltInShapes) {
  for (const char* shape : {"shape:plane", "shape:sphere", "shape:cloth"}) {
    const ProgramRun run = render(shape);
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_EQ(run.err, "");
    const Image picture = test::valueOf(readImage(output));
    ASSERT_EQ(picture.width, 40);
    ASSERT_EQ(picture.height, 30);
    EXPECT_GT(picture.pixel(20, 15)[0], 100) << shape << " is lit";
    EXPECT_EQ(picture.pixel(0, 0)[0], 0x28) << "the background is dark grey";
  }
}

TEST_F(RenderCommand, ALightShowsItsColourOnWhiteThatFacesIt) {
  const std::string picture = (folder / "out.exr").string();
  for (const char* size : {"9x9", "9 9"}) {
    std::vector<std::string> arguments{
        "shape:plane", "-o", picture, "--camera", "0,0,3:0,0,0", "--light", "0,0,5:0.5,0.25,2", "--size"};
    if (std::string(size) == "9 9")
      arguments.insert(arguments.end(), {"9", "9"});
    else
      arguments.push_back(size);
    const ProgramRun run = test::runProgram("weft-render", arguments);
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const FloatImage image = test::valueOf(readExr(picture));
    ASSERT_EQ(image.width(), 9);
    EXPECT_NEAR(image.at(4, 4, *image.channelIndex("R")), 0.5f, 1e-3f);
    EXPECT_NEAR(image.at(4, 4, *image.channelIndex("G")), 0.25f, 1e-3f);
    EXPECT_NEAR(image.at(4, 4, *image.channelIndex("B")), 2.0f, 1e-3f);
    EXPECT_EQ(image.at(4, 4, *image.channelIndex("A")), 1.0f);
    EXPECT_EQ(image.at(0, 0, *image.channelIndex("A")), 0.0f);
  }
}

TEST_F(RenderCommand, AStudioIsTheLightOfWhatHasNone) {
  const auto pictureWith = [&](const std::vector<std::string>& more) {
    EXPECT_EQ(render("shape:cloth", more).exitCode, 0);
    return test::valueOf(readImage(output)).bytes;
  };
  const auto unlit = pictureWith({});
  EXPECT_EQ(pictureWith({"--light", "studio"}), unlit);
  EXPECT_NE(pictureWith({"--light", "studio", "--light", "3,1,2"}), unlit);
  std::filesystem::remove(output);
  expectBadUsage(render("shape:cloth", {"--light", "studios"}), "--light takes studio, x,y,z");
}

// Where the edge of the plane crosses a pixel.
TEST_F(RenderCommand, MoreSamplesHaveMoreShades) {
  const auto shades = [&](const std::string& samples) {
    const ProgramRun run = render("shape:plane", {"--samples", samples, "--camera", "0,0,3:0.2,0.1,0"});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    const Image picture = test::valueOf(readImage(output));
    std::set<int> found;
    for (std::size_t i = 0; i < picture.bytes.size(); i += 3)
      if (picture.bytes[i] < 120) found.insert(picture.bytes[i]);  // between background and plane
    return found.size();
  };
  EXPECT_EQ(shades("1"), 1u);
  EXPECT_GT(shades("4"), 1u);
  EXPECT_GT(shades("16"), shades("4"));
  std::filesystem::remove(output);
  expectBadUsage(render("shape:plane", {"--samples", "5"}), "--samples");
}

TEST_F(RenderCommand, DressesASceneInAReflectanceField) {
  test::writeConstantField(folder / "teal.rf.exr", {0.0f, 0.5f, 0.5f});
  const std::string scene = write("scene.gltf", test::planeGltf()).string();
  for (const char* name : {"base", "*"}) {
    const ProgramRun run =
        render(scene, {"--material", std::string(name) + "=" + (folder / "teal.rf.exr").string(), "--light",
                       "0,0,9", "--camera", "0,0,2:0,0,0", "--views", "1"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const Image picture = test::valueOf(readImage(output));
    EXPECT_EQ(picture.pixel(20, 15)[0], 0);
    EXPECT_NEAR(picture.pixel(20, 15)[1], 188, 1);  // 0.5 as sRGB
    EXPECT_NEAR(picture.pixel(20, 15)[2], 188, 1);
  }
}

TEST_F(RenderCommand, ShowsAnAnimationAtATime) {
  test::GltfText file;
  file.add<float>({-1, -1, 0, 1, -1, 0, 0, 1, 0}, "VEC3");
  file.add<float>({0, 2}, "SCALAR");
  file.add<float>({0, 0, 0, 10, 0, 0}, "VEC3");
  const std::string scene =
      write("scene.gltf",
            file.text(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
                      R"("animations":[{"samplers":[{"input":1,"output":2}],"channels":)"
                      R"([{"sampler":0,"target":{"node":0,"path":"translation"}}]}])"))
          .string();
  const auto litAt = [&](const char* time) {
    const ProgramRun run = render(scene, {"--time", time, "--camera", "0,0,3:0,0,0", "--light", "0,0,9"});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    return test::valueOf(readImage(output)).pixel(20, 15)[0] > 60;
  };
  EXPECT_TRUE(litAt("0"));
  EXPECT_FALSE(litAt("1"));
}

TEST_F(RenderCommand, AGltfPlaneLooksLikeTheBuiltInOne) {
  const std::string matt = R"({"name":"base","pbrMetallicRoughness":{"metallicFactor":0},)"
                           R"("extensions":{"KHR_materials_specular":{"specularFactor":0}}})";
  const std::string scene = write("scene.gltf", test::planeGltf(matt)).string();
  ASSERT_EQ(render(scene).exitCode, 0);
  const Image file = test::valueOf(readImage(output));
  ASSERT_EQ(render("shape:plane").exitCode, 0);
  EXPECT_EQ(test::valueOf(readImage(output)).bytes, file.bytes);
}

TEST_F(RenderCommand, ReportsWhatItMeasured) {
  const ProgramRun run = render("shape:plane", {"--frames", "3", "--json", "-"});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const auto report = nlohmann::json::parse(run.out);
  EXPECT_EQ(report["width"], 40);
  EXPECT_EQ(report["frames"], 3);
  EXPECT_GT(report["frame_ms"]["min"], 0.0);
  EXPECT_LE(report["frame_ms"]["min"], report["frame_ms"]["median"]);
  EXPECT_LE(report["frame_ms"]["median"], report["frame_ms"]["max"]);
}

TEST_F(RenderCommand, SaysWhatIsMissing) {
  expectBadInput(render((folder / "none.gltf").string()), "none.gltf: no such file");
  expectBadInput(render("shape:plane", {"--material", "*=" + (folder / "none.rf.exr").string()}),
                 "none.rf.exr");
  const std::string field =
      write("field.gltf", test::planeGltf(R"({"name":"cloth","extensions":)"
                                          R"({"WEFT_materials_btf":{"uri":"x.rf.exr"}}})"))
          .string();
  expectBadInput(render("shape:cube"), "shape:cube: there is no such shape");
  const ProgramRun run = render(field);
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_THAT(run.err, HasSubstr("field.gltf: the reflectance field of material \"cloth\" is left out"));
}

TEST_F(RenderCommand, SaysWhatIsBroken) {
  const std::string glb = test::planeGlb();
  expectBadInput(render(write("short.glb", glb.substr(0, glb.size() / 2)).string()), "short.glb: ");
  expectBadInput(render(write("text.gltf", "no JSON").string()), "text.gltf: this is a text, not valid glTF");
  write("broken.rf.exr", "no EXR");
  expectBadInput(render("shape:plane", {"--material", "*=" + (folder / "broken.rf.exr").string()}),
                 "broken.rf.exr");
}

TEST_F(RenderCommand, SaysWhichNamesThereAre) {
  test::writeConstantField(folder / "grey.rf.exr", glm::vec3(0.5f));
  const std::string scene = write("scene.gltf", test::planeGltf()).string();
  expectBadInput(render(scene, {"--material", "bass=" + (folder / "grey.rf.exr").string()}),
                 "there is no material \"bass\" (its materials are [\"base\"])");
  for (const std::string camera : {"front", "nan,0,1:0,0,0", "1e30,0,0:0,0,0"})
    expectBadInput(render(scene, {"--camera", camera}), "there is no camera \"" + camera + "\"");
}

TEST_F(RenderCommand, RefusesBadUsage) {
  expectBadUsage(test::runProgram("weft-render", {"-o", output}), "SCENE");
  expectBadUsage(test::runProgram("weft-render", {"shape:plane"}), "--output");
  expectBadUsage(test::runProgram("weft-render", {"shape:plane", "-o", (folder / "out.jpg").string()}),
                 ".png or .exr");
  expectBadUsage(render("shape:plane", {"--views", "2"}), "--views");
  expectBadUsage(render("shape:plane", {"--time", "nan"}), "--time");
  expectBadUsage(render("shape:plane", {"--animation", "walk"}), "--time");
  for (const char* scale : {"0", "-1", "nan", "1e38"})
    expectBadUsage(render("shape:plane", {"--uv-scale", scale}), "--uv-scale");
  for (const char* light : {"1,2", "1,2,3,", "1,2,nan", "1,2,1e30", "1,2,3:1,-1,1", "1,2,3:1,inf,1"})
    expectBadUsage(render("shape:plane", {"--light", light}), "--light");
  for (const char* camera : {"1,2,3:4,5", "1,2,3:1,2,3", "1e-30,0,0:0,0,0"})
    expectBadUsage(render("shape:plane", {"--camera", camera}), "--camera");
  expectBadUsage(render("shape:plane", {"--material", "wool.rf.exr"}), "--material");
  for (const char* size : {"0", "0x30", "40x", "40xx30", "9000x30", "100000x100000", "axb"})
    expectBadUsage(test::runProgram("weft-render", {"shape:plane", "-o", output, "--size", size}), "--size");
}

TEST_F(RenderCommand, OneNumberIsTheSizeOfASquare) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"shape:plane", "--size", "20"}, {"--size", "20", "shape:plane"}}) {
    std::vector<std::string> all{"-o", output};
    all.insert(all.end(), arguments.begin(), arguments.end());
    ASSERT_EQ(test::runProgram("weft-render", all).exitCode, 0);
    const Image picture = test::valueOf(readImage(output));
    EXPECT_EQ(picture.width, 20);
    EXPECT_EQ(picture.height, 20);
  }
}

/// The plane's square below a node, which may hide behind another.
std::string placedPlane(const std::string& node, const std::string& more = "") {
  return test::replaced(
      test::replaced(test::planeGltf(), R"({"mesh":0,"name":"plane"})", R"({"mesh":0,)" + node + "}" + more),
      R"("scenes":[{"nodes":[0]}])",
      more.empty() ? R"("scenes":[{"nodes":[0]}])" : R"("scenes":[{"nodes":[0,1]}])");
}

TEST_F(RenderCommand, AModelLooksTheSameAnywhereAndOfAnySize) {
  const auto picture = [&](const std::string& scene, std::vector<std::string> more = {}) {
    const ProgramRun run = render(write("scene.gltf", scene).string(), std::move(more));
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_EQ(run.err, "");
    return test::valueOf(readImage(output)).bytes;
  };
  const auto expected = picture(placedPlane(R"("scale":[1,1,1])"));
  EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 100) << "it is lit";
  for (const char* node :
       {R"("translation":[6400000,2133333.3333333335,-6400000])", R"("translation":[1e8,0,-1e8])",
        R"("scale":[1e9,1e9,1e9])", R"("scale":[1e-6,1e-6,1e-6])", R"("scale":[1e-12,1e-12,1e-12])",
        R"("translation":[1e9,1e9,1e9],"scale":[1e3,1e3,1e3])"})
    EXPECT_EQ(picture(placedPlane(node)), expected) << node;
  EXPECT_EQ(
      picture(placedPlane(R"("scale":[1,1,1])", R"(,{"mesh":0,"scale":[0,0,0],"translation":[50,0,0]})")),
      expected)
      << "what is hidden is not looked for";

  const auto nearby =
      picture(placedPlane(R"("scale":[1,1,1])"), {"--camera", "0.1,0.2,2:0,0,0", "--light", "1,1,1"});
  EXPECT_EQ(picture(placedPlane(R"("translation":[6400000,0,0])"),
                    {"--camera", "6400000.1,0.2,2:6400000,0,0", "--light", "6400001,1,1"}),
            nearby);
}

TEST_F(RenderCommand, GroundIsSeenUpToTheFeetHoweverFarItReaches) {
  const std::string ground = write("ground.gltf", placedPlane(R"("scale":[4e7,4e7,1])")).string();
  ASSERT_EQ(render(ground, {"--camera", "0,0,2:0,10,2", "--light", "0,0,20"}).exitCode, 0);
  const Image picture = test::valueOf(readImage(output));
  // Looked at along Y, down is up: the ground is above.
  EXPECT_GT(picture.pixel(20, 2)[0], 0x40) << "near";
  EXPECT_EQ(picture.pixel(20, 29)[0], 0x28) << "sky";
}

TEST_F(RenderCommand, ModelsOfNoSizeThatFloatsCanHoldAreRefused) {
  const auto run = [&](const std::string& node) {
    return render(write("scene.gltf", placedPlane(node)).string());
  };
  expectBadInput(run(R"("scale":[1e20,1e20,1e20])"), "scene.gltf: the scene is too large, 1e+20 across");
  expectBadInput(run(R"("scale":[1e-20,1e-20,1e-20])"), "scene.gltf: the scene is too small, 1e-20 across");
  expectBadInput(run(R"("translation":[1e20,0,0])"), "too far from its origin");
}

TEST_F(RenderCommand, AnEmptyPictureIsAWarning) {
  const std::string plane = write("plane.gltf", test::planeGltf()).string();
  const auto warning = [&](std::vector<std::string> more) {
    const ProgramRun run = render(plane, std::move(more));
    EXPECT_EQ(run.exitCode, 0);
    return run.err;
  };
  EXPECT_EQ(warning({"--camera", "0,0,2:0,0,0"}), "");
  EXPECT_THAT(warning({"--camera", "0,0,2:0,0,4"}),
              HasSubstr("out.png: nothing of the scene is in the picture"));
  EXPECT_THAT(warning({"--camera", "0,0,2:0,0,4", "--env", "studio"}), HasSubstr("nothing of the scene"));
  EXPECT_THAT(warning({"--camera", "0,0,-2:0,0,0"}), HasSubstr("out.png: the picture is empty"));
  EXPECT_THAT(warning({"--camera", "0,0,9e9:0,0,0"}), HasSubstr("too small to be seen"));
  const std::string report = (folder / "report.json").string();
  warning({"--camera", "0,0,2:0,0,4", "--json", report});
  EXPECT_EQ(nlohmann::json::parse(std::ifstream(report))["warnings"].size(), 1u);
}

TEST_F(RenderCommand, APictureTooLargeForOpenGLIsNamedBySize) {
  const ProgramRun run = test::runProgram(
      "weft-render", {"shape:plane", "-o", (folder / "out.exr").string(), "--size", "8192x8192"});
  if (run.exitCode == 0) GTEST_SKIP() << "this OpenGL has memory for it";
  expectBadInput(run, "--size 8192x8192: with 2 x 2 samples a pixel, ");
}

TEST_F(RenderCommand, FilesOfTheSceneAreNotReplaced) {
  const std::string textured = R"({"name":"base","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
                               R"("textures":[{"source":0}],"images":[{"uri":"white%20paint.png"})";
  const std::string scene = write("scene.gltf", test::planeGltf(textured)).string();
  const std::filesystem::path paint = folder / "white paint.png";
  Image white(1, 1, 3);
  white.bytes = {255, 255, 255};
  test::requireDone(writePng(paint, white));
  for (const std::vector<std::string>& outputs :
       {std::vector<std::string>{"-o", paint}, {"-o", output, "--json", paint}, {"-o", scene}}) {
    std::vector<std::string> arguments{scene, "--size", "4"};
    arguments.insert(arguments.end(), outputs.begin(), outputs.end());
    const ProgramRun run = test::runProgram("weft-render", arguments);
    EXPECT_EQ(run.exitCode, 2);
    EXPECT_THAT(run.err, HasSubstr("the output would replace an input"));
  }
  EXPECT_EQ(test::valueOf(readImage(paint)).bytes, white.bytes);
  expectNoOutput();
}

TEST_F(RenderCommand, QuietKeepsWarnings) {
  const std::string scene =
      write("scene.gltf",
            test::planeGltf(R"({"name":"base","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
                            R"("textures":[{"source":0}],"images":[{"uri":"none.png"})"))
          .string();
  EXPECT_THAT(render(scene, {"--quiet"}).err, HasSubstr("none.png"));
}

TEST_F(RenderCommand, ReadsTheSceneBehindTheSize) {
  for (const std::vector<std::string>& size : {std::vector<std::string>{"20x10"}, {"20", "10"}}) {
    std::vector<std::string> arguments{"-o", output, "--size"};
    arguments.insert(arguments.end(), size.begin(), size.end());
    arguments.push_back("shape:plane");
    const ProgramRun run = test::runProgram("weft-render", arguments);
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_EQ(test::valueOf(readImage(output)).width, 20);
  }
}

TEST_F(RenderCommand, LeavesNoOutputInAFolderThatIsNotThere) {
  const ProgramRun run =
      test::runProgram("weft-render", {"shape:plane", "-o", (folder / "none" / "out.png").string()});
  EXPECT_EQ(run.exitCode, 2);
  EXPECT_FALSE(std::filesystem::exists(folder / "none"));
}

TEST_F(RenderCommand, RendersMeasuredModels) {
  WEFT_DATA_FILE(suzi, "gltf/suzi.glb");
  EXPECT_EQ(render(suzi.string()).exitCode, 0);
  std::filesystem::remove(output);
  const std::filesystem::path helmet = test::dataFile("gltf/FlightHelmet/glTF/FlightHelmet.gltf");
  const ProgramRun warned = render(helmet.string());
  EXPECT_EQ(warned.exitCode, 0);
  EXPECT_THAT(warned.err, testing::HasSubstr("LeatherPartsMat_BaseColor.png: no such file"));
  test::writeConstantField(folder / "brown.rf.exr", {0.4f, 0.2f, 0.1f});
  const ProgramRun run =
      render(helmet.string(), {"--material", "LeatherPartsMat=" + (folder / "brown.rf.exr").string()});
  EXPECT_EQ(run.exitCode, 0) << run.err;
}

}  // namespace
}  // namespace weft
