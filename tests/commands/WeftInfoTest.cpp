#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "GltfText.h"
#include "ProgramRun.h"
#include "TestSupport.h"
#include "weft/core/Direction.h"
#include "weft/io/CoordinateMapFile.h"
#include "weft/io/ImageFile.h"
#include "weft/io/ReflectanceFieldFile.h"
#include "weft/measurement/BtfWriter.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProgramRun;
using test::requireDone;
using test::runProgram;
using test::valueOf;
using testing::AllOf;
using testing::HasSubstr;

const std::vector<glm::vec3> kViews{directionFromDegrees(0, 0), directionFromDegrees(30, 0),
                                    directionFromDegrees(30, 120)};

fs::path bakedZip() {
  const fs::path zip = test::testFolder() / "grey.zip";
  BtfDescription btf;
  btf.width = 8;
  btf.height = 4;
  btf.views = kViews;
  btf.lights = {directionFromDegrees(0, 0), directionFromDegrees(60, 90)};
  btf.encoding = Encoding::Gamma22;
  btf.name = "GREY";
  requireDone(writeBtfZip(zip, btf, [](int, std::span<float> out) -> Result<void> {
    std::fill(out.begin(), out.end(), 0.5f);
    return {};
  }));
  return zip;
}

fs::path fieldFile() {
  const fs::path file = test::testFolder() / "grey.rf.exr";
  const auto model = valueOf(ModelRegistry::builtin().create({}));
  ReflectanceFieldDescription about;
  about.views = kViews;
  about.lights = {directionFromDegrees(0, 0)};
  about.source = "GREY";
  about.fitReport = R"({"epsilon":{"linear":{"luminance":{"avg":0.0301}}}})";
  FloatImage shared(5, 7, model->sharedChannels());
  FloatImage views(5, 7, model->layerChannels(), 3);
  shared.roundToHalf();
  views.roundToHalf();
  requireDone(writeReflectanceField(valueOf(ReflectanceField::create(model, about, shared, views)), file));
  return file;
}

void expectRefused(const ProgramRun& run, const std::string& message) {
  EXPECT_EQ(run.exitCode, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_THAT(run.err,
              AllOf(testing::StartsWith("weft-info: "), HasSubstr(message), testing::EndsWith("\n")));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

TEST(WeftInfo, DescribesAMeasurement) {
  const fs::path zip = bakedZip();
  const ProgramRun run = runProgram("weft-info", {zip, "--json", "-"});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const json expected = {{"kind", "btf"},
                         {"name", "grey"},
                         {"width", 8},
                         {"height", 4},
                         {"views", 3},
                         {"lights", 2},
                         {"encoding", "gamma2.2"},
                         {"has_cosine", true},
                         {"bytes", {{"file", fs::file_size(zip)}}}};
  EXPECT_EQ(json::parse(run.out), expected);
  EXPECT_THAT(runProgram("weft-info", {zip}).out, AllOf(HasSubstr("views                    3\n"),
                                                        HasSubstr("encoding                 gamma2.2\n")));
}

TEST(WeftInfo, DescribesAFolder) {
  const fs::path folder = test::testFolder() / "set";
  fs::create_directories(folder);
  requireDone(writePng(folder / "tl000_pl000_tv000_pv000.png", Image(3, 2, 3)));
  const ProgramRun run = runProgram("weft-info", {folder, "--json", "-"});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const json info = json::parse(run.out);
  EXPECT_EQ(info.at("name"), "set");
  EXPECT_EQ(info.at("encoding"), "srgb");
  EXPECT_EQ(info.at("lights"), 1);
}

TEST(WeftInfo, DescribesALightList) {
  const fs::path folder = test::testFolder();
  requireDone(writePng(folder / "a.png", Image(3, 2, 3)));
  const fs::path list = folder / "coin.lp";
  std::ofstream(list) << "1\na.png 0 0 2\n";
  const ProgramRun run = runProgram("weft-info", {list, "--json", "-"});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const json expected = {
      {"kind", "btf"},      {"name", "coin"},     {"width", 3},
      {"height", 2},        {"views", 1},         {"lights", 1},
      {"encoding", "srgb"}, {"has_cosine", true}, {"bytes", {{"file", fs::file_size(list)}}}};
  EXPECT_EQ(json::parse(run.out), expected);
  std::ofstream(list) << "3\na.png 0 0 2\n";
  expectRefused(runProgram("weft-info", {list}), "coin.lp: line 1 counts 3 lights, 1 are listed");
}

TEST(WeftInfo, DescribesAReflectanceField) {
  const fs::path file = fieldFile();
  const fs::path report = file.parent_path() / "report.json";
  const ProgramRun run = runProgram("weft-info", {file, "--json", report});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("model.name               rfnl\n"));
  const json info = json::parse(std::ifstream(report));
  EXPECT_EQ(info.at("kind"), "reflectance field");
  EXPECT_EQ(info.at("width"), 5);
  EXPECT_EQ(info.at("height"), 7);
  EXPECT_EQ(info.at("views"), 3);
  EXPECT_EQ(info.at("lights"), 1);
  EXPECT_EQ(info.at("has_cosine"), false);
  EXPECT_EQ(info.at("precision"), "half");
  EXPECT_EQ(info.at("model").at("lobes"), 2);
  EXPECT_EQ(info.at("fit").at("epsilon").at("linear").at("luminance").at("avg"), 0.0301);
  EXPECT_EQ(info.at("bytes").at("file"), fs::file_size(file));
  EXPECT_EQ(info.at("bytes").at("gpu"), 5 * 7 * 8 * (1 + 3 * 2));
}

TEST(WeftInfo, DescribesACoordinateMap) {
  const fs::path file = test::testFolder() / "a.coords.exr";
  requireDone(writeCoordinateMap(
      file, valueOf(CoordinateMap::create(3, 2, 16, 8, std::vector<glm::u16vec2>(6), "WOOL"))));
  const ProgramRun run = runProgram("weft-info", {file.string(), "--json", "-"});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const json info = json::parse(run.out);
  EXPECT_EQ(info["kind"], "coordinate map");
  EXPECT_EQ(info["name"], "WOOL");
  EXPECT_EQ(info["width"], 3);
  EXPECT_EQ(info["sample"], json({{"width", 16}, {"height", 8}}));
  EXPECT_EQ(info["bytes"]["gpu"], 12);
}

TEST(WeftInfo, DescribesAScene) {
  const fs::path file = test::testFolder() / "scene.gltf";
  std::string scene = test::planeGltf(
      R"({"name":"seat","extensions":{"WEFT_materials_btf":{"uri":"none.rf.exr","scale":[12,12]}}})");
  scene = test::replaced(scene, R"({"mesh":0,)", R"({"scale":[2,2,2],"camera":0,"mesh":0,)");
  scene.insert(1,
               R"("cameras":[{"name":"front","type":"perspective","perspective":{"yfov":1,"znear":0.1}}],)");
  std::ofstream(file) << scene;
  const ProgramRun run = runProgram("weft-info", {file.string(), "--json", "-"});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const json info = json::parse(run.out);
  EXPECT_EQ(info.at("kind"), "scene");
  EXPECT_EQ(info.at("bounds"), json::parse(R"({"min":[-1.0,-1.0,0.0],"max":[1.0,1.0,0.0]})"));
  EXPECT_EQ(info.at("cameras"), json::parse(R"([{"name":"front","projection":"perspective"}])"));
  EXPECT_EQ(info.at("materials"), json::parse(R"([{"name":"seat","triangles":2,"area":4.0,
      "texture_coordinates":{"u":[0.0,1.0],"v":[0.0,1.0]},"unit_length":2.0,
      "btf":{"uri":"none.rf.exr","scale":[12,12]}}])"));
  EXPECT_EQ(info.at("lights"), 0);
  EXPECT_THAT(runProgram("weft-info", {file.string()}).out, HasSubstr("materials.0.name         seat\n"));
  std::ofstream(file) << R"({"asset":{"version":"2.0"}})";
  expectRefused(runProgram("weft-info", {file.string()}), "scene.gltf: ");
}

TEST(WeftInfo, AsksForNoTextureCoordinatesWhereNothingHasTextures) {
  const fs::path file = test::testFolder() / "scene.gltf";
  const auto warningsOf = [&](const std::string& material) {
    std::ofstream(file) << test::replaced(test::planeGltf(material), R"(,"TEXCOORD_0":2)", "");
    return json::parse(runProgram("weft-info", {file.string(), "--json", "-"}).out).at("warnings").size();
  };
  EXPECT_EQ(warningsOf("{}"), 0u);
  EXPECT_EQ(warningsOf(R"({"extensions":{"WEFT_materials_btf":{"uri":"none.rf.exr"}}})"), 1u);
  EXPECT_EQ(warningsOf(R"({"normalTexture":{"index":0}})"), 1u);
}

TEST(WeftInfo, SaysTheEncodingOfTheFile) {
  const auto model = valueOf(ModelRegistry::builtin().create({.name = "ptm"}));
  ReflectanceFieldDescription about;
  about.views = about.lights = {{0, 0, 1}};
  about.hasCosine = true;
  about.encoding = Encoding::Srgb;
  const fs::path file = test::testFolder() / "coin.rf.exr";
  requireDone(writeReflectanceField(
      valueOf(ReflectanceField::create(model, about, FloatImage(2, 2, model->sharedChannels()),
                                       FloatImage(2, 2, model->layerChannels(), 1))),
      file));
  const json info = json::parse(runProgram("weft-info", {file, "--json", "-"}).out);
  EXPECT_EQ(info.at("encoding"), "srgb");
  EXPECT_EQ(info.at("has_cosine"), true);
}

// Also of a field that is not named as one.
TEST(WeftInfo, ToldByTheFirstBytesWhatAFileIs) {
  const fs::path field = fieldFile();
  fs::rename(field, field.parent_path() / "grey.field");
  EXPECT_THAT(runProgram("weft-info", {field.parent_path() / "grey.field"}).out,
              HasSubstr("reflectance field"));
}

TEST(WeftInfo, TellsWhatOfAMeasurementIsNotAsItSays) {
  const fs::path folder = test::testFolder();
  requireDone(writePng(folder / "a.png", Image(3, 2, 3)));
  const fs::path list = folder / "coin.lp";
  std::ofstream(list) << "1\nIMG_1.CR2 0 0 1\n";
  expectRefused(runProgram("weft-info", {list}), "coin.lp, line 2: there is no image 'IMG_1.CR2'");
  EXPECT_EQ(runProgram("weft-info", {list, "--in-order"}).exitCode, 0);
  std::ofstream(list) << "1\na.CR2 0 0 1\n";
  const ProgramRun run = runProgram("weft-info", {list, "--quiet"});
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.err,
            "weft-info: " + list.string() +
                ": images are taken whose names differ from the list's in the extension: a.png for a.CR2\n");
}

TEST(WeftInfo, OpenExrsOwnToolUnderstandsAReflectanceField) {
  const ProgramRun run = runProgram("/usr/bin/exrheader", {fieldFile()});
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("name (type string): \"shared\""), HasSubstr("name (type string): \"view002\""),
                    HasSubstr("lobe1.exponent, 16-bit floating-point"),
                    HasSubstr("weftReflectanceField (type string)")));
}

TEST(WeftInfo, RefusesBadInput) {
  const fs::path folder = test::testFolder() / "folder";
  fs::create_directories(folder);
  const std::string report = (folder.parent_path() / "out.json").string();
  const auto infoOn = [&](const fs::path& file) { return runProgram("weft-info", {file, "--json", report}); };
  expectRefused(infoOn(folder / "none.zip"), "none.zip: no such file or folder");
  expectRefused(infoOn(folder), "folder: there are no images named by their angles");
  std::ofstream(folder / "text.rf.exr") << "hello";
  expectRefused(infoOn(folder / "text.rf.exr"), "text.rf.exr: this is a text, not an OpenEXR file");
  std::ofstream(folder / "text.zip") << "hello";
  expectRefused(infoOn(folder / "text.zip"), "text.zip: this is a text, not a measurement");
  std::ofstream(folder / "tl000_pl000_tv000_pv000.jpg") << "hello";
  expectRefused(infoOn(folder), "tl000_pl000_tv000_pv000.jpg: this is a text, not a JPEG or PNG image");
  EXPECT_FALSE(fs::exists(report));
}

TEST(WeftInfo, RefusesATruncatedZip) {
  const fs::path zip = bakedZip();
  fs::resize_file(zip, fs::file_size(zip) / 2);
  expectRefused(runProgram("weft-info", {zip}), "grey.zip: not a complete zip");
}

TEST(WeftInfo, RefusesATruncatedReflectanceField) {
  const fs::path file = fieldFile();
  fs::resize_file(file, fs::file_size(file) - 10);
  expectRefused(runProgram("weft-info", {file}), "grey.rf.exr: ");
}

TEST(WeftInfo, RefusesBadUsage) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{}, {"a", "b"}, {"a", "--unknown"}, {"a", "--threads", "x"}}) {
    const ProgramRun run = runProgram("weft-info", arguments);
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_THAT(run.err, testing::StartsWith("weft-info: "));
  }
}

}  // namespace
}  // namespace weft
