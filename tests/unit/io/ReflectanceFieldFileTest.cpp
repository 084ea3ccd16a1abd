#include "weft/io/ReflectanceFieldFile.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "RampModel.h"
#include "SomeModels.h"
#include "TestImages.h"
#include "TestSupport.h"
#include "weft/core/Direction.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::requireDone;
using test::valueOf;
using testing::HasSubstr;

constexpr int kWidth = 6;
constexpr int kHeight = 19;  // more than one block of scan lines
constexpr int kViews = 4;

FloatImage madeUpParameters(const std::vector<std::string>& channels, int layers) {
  FloatImage image(kWidth, kHeight, channels, layers);
  for (std::size_t i = 0; i < image.values().size(); ++i)
    image.values()[i] = std::sin(0.37f * static_cast<float>(i)) + 1.1f;
  return image;
}

ReflectanceField madeUpField(const ModelDescription& description, Precision precision) {
  const auto model = valueOf(ModelRegistry::builtin().create(description));
  ReflectanceFieldDescription about;
  about.views = {directionFromDegrees(0, 0), directionFromDegrees(33.3, 10),
                 directionFromDegrees(60.1, 133.7), directionFromDegrees(75, 271)};
  about.lights = {directionFromDegrees(0, 0), directionFromDegrees(17.7, 12.3),
                  directionFromDegrees(40, 200)};
  about.hasCosine = true;
  about.source = "wool \"knitted\" \xc3\xa4";
  about.fitReport = R"({"epsilon":{"linear":{"luminance":{"avg":0.0301}}},"b":[1,2],"a":null})";
  FloatImage shared = madeUpParameters(model->sharedChannels(), 1);
  FloatImage layers;
  if (const int count = valueOf(FieldFormula::create(model, about)).storedLayers(); count > 0)
    layers = madeUpParameters(model->layerChannels(), count);
  if (precision == Precision::Half) shared.roundToHalf();
  if (precision == Precision::Half && !layers.empty()) layers.roundToHalf();
  return valueOf(ReflectanceField::create(model, about, {{shared, layers}},
                                          test::unevenTables(*model, static_cast<int>(about.views.size()))));
}

void expectEqual(const FloatImage& actual, const FloatImage& expected) {
  EXPECT_EQ(actual.channels(), expected.channels());
  EXPECT_EQ(actual.precision(), expected.precision());
  ASSERT_EQ(actual.values().size(), expected.values().size());
  EXPECT_TRUE(std::equal(actual.values().begin(), actual.values().end(), expected.values().begin()));
}

std::string errorOfField(const fs::path& file) {
  const auto field = readReflectanceField(file, ModelRegistry::builtin());
  return field ? "read" : field.error().message();
}

// A copy of a file whose manifest has something else in one place.
void copyWithManifest(const fs::path& from, const fs::path& to, const std::string& what,
                      const std::string& with) {
  Imf::MultiPartInputFile source(from.c_str());
  std::vector<Imf::Header> headers;
  for (int part = 0; part < source.parts(); ++part) headers.push_back(source.header(part));
  auto& attribute = headers[0].typedAttribute<Imf::StringAttribute>("weftReflectanceField");
  const std::size_t at = attribute.value().find(what);
  ASSERT_NE(at, std::string::npos) << what;
  attribute.value().replace(at, what.size(), with);
  Imf::MultiPartOutputFile target(to.c_str(), headers.data(), source.parts());
  for (int part = 0; part < source.parts(); ++part) {
    Imf::InputPart pixels(source, part);
    Imf::OutputPart(target, part).copyPixels(pixels);
  }
}

TEST(ReflectanceFieldFile, KeepsEverything) {
  const fs::path folder = test::testFolder();
  const fs::path file = folder / "a.rf.exr";
  for (const ModelDescription& model : test::someModels())
    for (Precision precision : {Precision::Half, Precision::Float}) {
      const ReflectanceField written = madeUpField(model, precision);
      requireDone(writeReflectanceField(written, file));
      const ReflectanceField read = valueOf(readReflectanceField(file, ModelRegistry::builtin()));
      EXPECT_EQ(read.model().description(), written.model().description());
      EXPECT_EQ(read.description().views, written.description().views);
      EXPECT_EQ(read.description().lights, written.description().lights);
      EXPECT_EQ(read.description().hasCosine, written.description().hasCosine);
      EXPECT_EQ(read.description().source, written.description().source);
      EXPECT_EQ(read.description().fitReport, written.description().fitReport);
      expectEqual(read.shared(), written.shared());
      expectEqual(read.layers(), written.layers());
      ASSERT_EQ(read.tables().size(), written.tables().size());
      for (const auto& [name, table] : written.tables()) expectEqual(read.tables().at(name), table);
    }
  EXPECT_THAT(test::namesIn(folder), testing::ElementsAre("a.rf.exr"));
}

// Three levels, the last of one texel, and a table.
ReflectanceField rampField() {
  const ModelRegistry models = test::RampModel::registry();
  const auto model = valueOf(models.create({"ramp", {{"power", 2}}}));
  ReflectanceFieldDescription about;
  about.views = about.lights = {directionFromDegrees(0, 0), directionFromDegrees(33.3, 10),
                                directionFromDegrees(40, 200)};
  std::vector<FieldLevel> levels;
  for (const auto& [width, height] : {std::pair(5, 2), {2, 1}, {1, 1}}) {
    levels.push_back({FloatImage(width, height, model->sharedChannels()),
                      FloatImage(width, height, model->layerChannels(), 3)});
    for (FloatImage* image : {&levels.back().shared, &levels.back().layers})
      for (std::size_t i = 0; i < image->values().size(); ++i)
        image->values()[i] = std::sin(0.7f * static_cast<float>(i + levels.size()));
  }
  levels[1].layers.roundToHalf();
  FloatImage ramp(7, 1, {"value"});
  for (int x = 0; x < 7; ++x) ramp.at(x, 0, 0) = 0.1f * static_cast<float>(x);
  return valueOf(ReflectanceField::create(model, about, levels, {{"ramp", ramp}}));
}

TEST(ReflectanceFieldFile, KeepsLevelsTablesAndOptions) {
  const fs::path path = test::testFolder() / "a.rf.exr";
  const ReflectanceField written = rampField();
  requireDone(writeReflectanceField(written, path));
  const ReflectanceField read = valueOf(readReflectanceField(path, test::RampModel::registry()));
  EXPECT_EQ(read.model().description(), written.model().description());
  ASSERT_EQ(read.levels().size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    expectEqual(read.levels()[i].shared, written.levels()[i].shared);
    expectEqual(read.levels()[i].layers, written.levels()[i].layers);
  }
  expectEqual(read.tables().at("ramp"), written.tables().at("ramp"));
  EXPECT_EQ(read.evaluate(3, 1, {0, 0, 1}, {0, 0, 1}), written.evaluate(3, 1, {0, 0, 1}, {0, 0, 1}));

  const Imf::MultiPartInputFile file(path.c_str());
  std::vector<std::string> names;
  for (int part = 0; part < file.parts(); ++part) names.push_back(file.header(part).name());
  EXPECT_THAT(names,
              testing::ElementsAre("shared", "view000", "view001", "view002", "level1.shared",
                                   "level1.view000", "level1.view001", "level1.view002", "level2.shared",
                                   "level2.view000", "level2.view001", "level2.view002", "table.ramp"));
}

TEST(ReflectanceFieldFile, ARegistryWithoutTheModelSaysWhichItHas) {
  const fs::path path = test::testFolder() / "a.rf.exr";
  requireDone(writeReflectanceField(rampField(), path));
  EXPECT_EQ(errorOfField(path), path.string() +
                                    ": unknown model 'ramp' (known are rfp, lfp, ptm, rfnl, lfnl, "
                                    "laf, slaf, bump, loom, loom_gloss, lod)");
}

// The manifest of a file, changed in one place.
TEST(ReflectanceFieldFile, RefusesOptionsLevelsAndTablesThatDoNotFit) {
  const fs::path folder = test::testFolder();
  requireDone(writeReflectanceField(rampField(), folder / "good.rf.exr"));
  const std::vector<std::tuple<std::string, std::string, std::string>> changes{
      {R"("power":2)", R"("power":7)", "'power' of the model 'ramp' cannot be 7 (0 to 3)"},
      {R"("power":2)", R"("power":2.5)", "the option 'power' is neither a word nor a whole number"},
      {R"("power":2)", R"("power":99999999999)", "the option 'power' is neither a word nor a whole number"},
      {R"("power":2)", R"("lobes":2)", "the model 'ramp' has no option 'lobes' (its options are power)"},
      {R"("options":{"power":2})", R"("options":2)", "the options of the model are not an object"},
      {R"("width":5)", R"("width":6)", "level 0 has 5 x 2 texels, not 6 x 2 as the manifest says"},
      {R"(,{"width":1,"height":1})", "", "the manifest describes 9 parts, the file has 13"},
      {R"("levels":[{)", R"("levels":[],"others":[{)", "the levels are not a list of sizes"},
      {R"("tables":["ramp"])", R"("tables":[])", "the manifest describes 12 parts, the file has 13"},
      {R"("tables":["ramp"])", R"("tables":["stairs"])", "the model 'ramp' has no table 'stairs'"},
      {R"("tables":["ramp"])", R"("tables":["ramp","ramp"])", "not in alphabetical order"},
      {R"("version":3)", R"("version":4)", "the file has format version 4, this Weft reads versions 2 to 3"},
      {R"("version":3)", R"("version":1)", "the file has format version 1, this Weft reads versions 2 to 3"},
  };
  for (const auto& [what, with, message] : changes) {
    copyWithManifest(folder / "good.rf.exr", folder / "bad.rf.exr", what, with);
    const auto field = readReflectanceField(folder / "bad.rf.exr", test::RampModel::registry());
    ASSERT_FALSE(field) << message;
    EXPECT_THAT(field.error().message(), AllOf(HasSubstr("bad.rf.exr: "), HasSubstr(message)));
  }
}

TEST(ReflectanceFieldFile, WritesEqualBytesWhateverItsName) {
  const fs::path folder = test::testFolder();
  const ReflectanceField field = madeUpField({}, Precision::Half);
  requireDone(writeReflectanceField(field, folder / "a.rf.exr"));
  requireDone(writeReflectanceField(field, folder / "another name.rf.exr"));
  EXPECT_EQ(test::bytesOf(folder / "a.rf.exr"), test::bytesOf(folder / "another name.rf.exr"));
}

TEST(ReflectanceFieldFile, WritesEqualBytesOnAnyNumberOfThreads) {
  const fs::path folder = test::testFolder();
  const ReflectanceField field = madeUpField({}, Precision::Half);
  for (const int threads : {1, 3}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    requireDone(writeReflectanceField(field, folder / (std::to_string(threads) + ".rf.exr")));
  }
  EXPECT_EQ(test::bytesOf(folder / "1.rf.exr"), test::bytesOf(folder / "3.rf.exr"));
}

// docs/file-format.md, read by OpenEXR alone.
TEST(ReflectanceFieldFile, LooksAsDocumented) {
  const fs::path path = test::testFolder() / "a.rf.exr";
  const ReflectanceField field = madeUpField({}, Precision::Half);
  requireDone(writeReflectanceField(field, path));
  Imf::MultiPartInputFile file(path.c_str());
  ASSERT_EQ(file.parts(), 1 + kViews);
  EXPECT_EQ(file.header(0).name(), "shared");
  EXPECT_EQ(file.header(4).name(), "view003");
  EXPECT_NE(file.header(0).findTypedAttribute<Imf::StringAttribute>("weftReflectanceField"), nullptr);
  EXPECT_EQ(file.header(3).channels().findChannel("lobe1.exponent")->type, Imf::HALF);
  std::vector<float> exponents(kWidth * kHeight);
  Imf::InputPart part(file, 3);
  Imf::FrameBuffer buffer;
  buffer.insert("lobe1.exponent", Imf::Slice::Make(Imf::FLOAT, exponents.data(), part.header().dataWindow()));
  part.setFrameBuffer(buffer);
  part.readPixels(0, kHeight - 1);
  const int channel = *field.layers().channelIndex("lobe1.exponent");
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      ASSERT_EQ(exponents[static_cast<std::size_t>(y * kWidth + x)], field.layers().at(x, y, channel, 2));
}

TEST(ReflectanceFieldFile, RefusesAFitReportThatIsNotJson) {
  const fs::path folder = test::testFolder();
  const ReflectanceField good = madeUpField({}, Precision::Half);
  for (const std::string& report :
       {std::string("{\"avg\":"), std::string(100, '[') + std::string(100, ']')}) {
    ReflectanceFieldDescription about = good.description();
    about.fitReport = report;
    const auto model = valueOf(ModelRegistry::builtin().create({}));
    const ReflectanceField bad =
        valueOf(ReflectanceField::create(model, about, good.shared(), good.layers()));
    const Result<void> result = writeReflectanceField(bad, folder / "a.rf.exr");
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message(), HasSubstr("the fit report is not JSON"));
    EXPECT_THAT(test::namesIn(folder), testing::IsEmpty());
  }
}

TEST(ReflectanceFieldFile, RefusesMissingAndForeignFiles) {
  const fs::path folder = test::testFolder();
  EXPECT_THAT(errorOfField(folder / "none.rf.exr"), HasSubstr("none.rf.exr: no such file"));
  test::writeBytes(folder / "text.rf.exr", {'h', 'e', 'l', 'l', 'o'});
  EXPECT_THAT(errorOfField(folder / "text.rf.exr"),
              HasSubstr("text.rf.exr: this is a text, not an OpenEXR file"));
}

TEST(ReflectanceFieldFile, RefusesEveryTruncation) {
  const fs::path file = test::testFolder() / "a.rf.exr";
  requireDone(writeReflectanceField(madeUpField({}, Precision::Half), file));
  const test::Bytes whole = test::bytesOf(file);
  for (std::size_t size = 0; size < whole.size(); size += 61) {
    test::writeBytes(file, test::Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
    ASSERT_THAT(errorOfField(file), HasSubstr("a.rf.exr: ")) << size;
  }
}

TEST(ReflectanceFieldFile, SurvivesMutations) {
  const fs::path file = test::testFolder() / "a.rf.exr";
  requireDone(writeReflectanceField(madeUpField({}, Precision::Half), file));
  const test::Bytes whole = test::bytesOf(file);
  unsigned random = 3;
  for (int i = 0; i < 400; ++i) {
    test::Bytes bytes = whole;
    for (int k = 0; k < 2; ++k) {
      random = random * 1664525u + 1013904223u;
      bytes[(random >> 8) % (i % 2 ? std::size_t{2000} : bytes.size())] = static_cast<std::uint8_t>(random);
    }
    test::writeBytes(file, bytes);
    EXPECT_NE(errorOfField(file), "");  // read or refused, without harm
  }
}

// Files made by another hand, wrong in one way each.
struct ForeignFile {
  std::string manifest =
      R"({"format":"weft reflectance field","version":2,"model":{"name":"rfp","lobes":0,"diffuse_albedo":"shared","color":"luminance"},)"
      R"("color_space":"linear Rec. 709","encoding":"linear","has_cosine":false,"source":"","fit":null,)"
      R"("views":[[0,0,1]],"lights":[[0,0,1]]})";
  std::string sharedName = "shared";
  std::string viewName = "view000";
  std::vector<std::string> sharedChannels{"R", "G", "B"};
  std::vector<std::string> viewChannels{"a0", "a1", "a2", "a3", "a4", "a5"};
  int viewWidth = 4;
  float value = 0.5f;

  void replace(const std::string& what, const std::string& with) {
    const std::size_t at = manifest.find(what);
    ASSERT_NE(at, std::string::npos);
    manifest.replace(at, what.size(), with);
  }

  void write(const fs::path& path) const {
    const auto header = [](int width, const std::string& name, const std::vector<std::string>& channels) {
      Imf::Header result(Imath::Box2i({0, 0}, {3, 3}), Imath::Box2i({0, 0}, {width - 1, 3}));
      result.setName(name);
      result.setType(Imf::SCANLINEIMAGE);
      for (const std::string& channel : channels) result.channels().insert(channel, Imf::Channel(Imf::FLOAT));
      return result;
    };
    std::vector<Imf::Header> headers{header(4, sharedName, sharedChannels),
                                     header(viewWidth, viewName, viewChannels)};
    headers[0].insert("weftReflectanceField", Imf::StringAttribute(manifest));
    Imf::MultiPartOutputFile file(path.c_str(), headers.data(), 2);
    const std::vector<float> values(64, value);
    for (int i = 0; i < 2; ++i) {
      Imf::FrameBuffer buffer;
      for (const std::string& channel : i == 0 ? sharedChannels : viewChannels)
        buffer.insert(channel, Imf::Slice::Make(Imf::FLOAT, values.data(),
                                                headers[static_cast<std::size_t>(i)].dataWindow()));
      Imf::OutputPart part(file, i);
      part.setFrameBuffer(buffer);
      part.writePixels(4);
    }
  }
};

std::string errorOfField(const ForeignFile& foreign) {
  const fs::path file = test::testFolder() / "foreign.rf.exr";
  foreign.write(file);
  return errorOfField(file);
}

TEST(ReflectanceFieldFile, ReadsAFileByAnotherHand) {
  EXPECT_EQ(errorOfField(ForeignFile()), "read");
}

TEST(ReflectanceFieldFile, RefusesWrongManifests) {
  const std::vector<std::tuple<std::string, std::string, std::string>> changes{
      {"\"version\":2", "\"version\":4", "this Weft reads versions 2 to 3"},
      {"weft reflectance field", "something", "another format"},
      {"\"rfp\"", "\"rfq\"", "unknown model 'rfq'"},
      {"\"shared\"", "\"none\"", "unknown diffuse_albedo 'none'"},
      {"\"luminance\"", "\"hue\"", "unknown color 'hue'"},
      {"\"linear\"", "\"log\"", "unknown encoding 'log'"},
      {"linear Rec. 709", "XYZ", "unknown colour space"},
      {"\"views\":[[0,0,1]]", "\"views\":[[0,0,1],[0.6,0,0.8],[0,0.6,0.8]]",
       "describes 4 parts, the file has 2"},
      {"\"views\":[[0,0,1]]", "\"views\":[]", "directions are not an array"},
      {"\"views\":[[0,0,1]]", "\"views\":[[0,1]]", "has not three numbers"},
      {"\"views\":[[0,0,1]]", "\"views\":[[0,0,\"up\"]]", "the manifest is damaged"},
      {"\"views\":[[0,0,1]]", "\"views\":[[0,0,2]]", "not of unit length"},
      {"\"lights\":[[0,0,1]]", "\"lights\":[[3,0,1]]", "not of unit length"},
      {"\"has_cosine\":false,", "", "the manifest is damaged"},
      {"false", "17", "the manifest is damaged"},
      {"}", "", "the manifest is damaged"},
      {"\"fit\":null", "\"fit\":" + std::string(2000, '[') + std::string(2000, ']'), "nested too deeply"},
  };
  for (const auto& [what, with, message] : changes) {
    ForeignFile foreign;
    foreign.replace(what, with);
    EXPECT_THAT(errorOfField(foreign), HasSubstr("foreign.rf.exr: "));
    EXPECT_THAT(errorOfField(foreign), HasSubstr(message));
  }
}

TEST(ReflectanceFieldFile, RefusesWrongParts) {
  ForeignFile names;
  names.viewName = "view001";
  EXPECT_THAT(errorOfField(names), HasSubstr("part 1 is not named 'view000'"));
  ForeignFile channels;
  channels.viewChannels = {"a0", "a1", "a2", "a3", "a4", "b5"};
  EXPECT_THAT(errorOfField(channels), HasSubstr("the channels of part 'view000' are not those of the model"));
  ForeignFile sharedChannels;
  sharedChannels.sharedChannels = {"R", "G"};
  EXPECT_THAT(errorOfField(sharedChannels), HasSubstr("the channels of part 'shared'"));
  ForeignFile size;
  size.viewWidth = 3;
  EXPECT_THAT(errorOfField(size), HasSubstr("part 'view000' differs in size"));
}

TEST(ReflectanceFieldFile, RefusesNumbersThatAreNotFinite) {
  for (const float value : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
    ForeignFile foreign;
    foreign.value = value;
    EXPECT_THAT(errorOfField(foreign), HasSubstr("number is not finite"));
  }
}

TEST(ReflectanceFieldFile, RefusesAPlainImage) {
  const fs::path path = test::testFolder() / "plain.exr";
  Imf::Header header(4, 4);
  header.setType(Imf::SCANLINEIMAGE);
  header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
  {
    const std::vector<float> values(16);
    Imf::MultiPartOutputFile file(path.c_str(), &header, 1);
    Imf::OutputPart part(file, 0);
    Imf::FrameBuffer buffer;
    buffer.insert("Y", Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow()));
    part.setFrameBuffer(buffer);
    part.writePixels(4);
  }
  EXPECT_THAT(errorOfField(path), HasSubstr("the OpenEXR file has no manifest"));
}

}  // namespace
}  // namespace weft
