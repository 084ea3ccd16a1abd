// The uris of buffers, images and reflectance fields: one rule for all.

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>

#include "GltfScenes.h"
#include "TestField.h"
#include "weft/io/ImageFile.h"
#include "weft/materials/BTFMaterial.h"
#include "weft/materials/PBRMaterial.h"

namespace weft {
namespace {

using test::drawnIn;
using test::Json;
using test::valueOf;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// A triangle whose buffer, base colour and field are files of this folder.
class GltfReference : public testing::Test {
 protected:
  void SetUp() override {
    folder = test::testFolder() / "scene";
    std::filesystem::create_directories(folder);
    file = test::triangleGltf();
    file["materials"] = Json::parse(
        R"([{"name":"m","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},
            {"name":"f","extensions":{"WEFT_materials_btf":{"uri":"none"}}}])");
    file["textures"] = Json::parse(R"([{"source":0}])");
    file["images"] = Json::parse(R"([{"uri":"none"}])");
    Json& primitives = file["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);
    primitives[0]["material"] = 0;
    primitives[1]["material"] = 1;
    const std::string& embedded = file["buffers"][0]["uri"].get_ref<const std::string&>();
    bufferUri = embedded;
  }

  /// Puts the three files at these places and names them so; empty where all three are shown, else
  /// why not.
  std::string missing(const std::filesystem::path& place, const std::string& uri) {
    std::filesystem::create_directories(place.parent_path());
    const auto named = [](std::filesystem::path path, const char* suffix) { return path += suffix; };
    const std::vector<float> numbers{0, 0, 0, 1, 0, 0, 0, 1, 0};
    std::ofstream(named(place, ".bin"), std::ios::binary)
        .write(reinterpret_cast<const char*>(numbers.data()), 36);
    test::requireDone(writePng(named(place, ".png"), Image(2, 2, 3)));
    test::requireDone(writeReflectanceField(test::testField(), named(place, ".rf.exr")));
    return missing(uri + ".bin", uri + ".png", uri + ".rf.exr");
  }

  // The meshes here have no texture coordinates.
  static bool isOfCoordinates(const std::string& warning) {
    return warning.find("TEXCOORD_0") != std::string::npos;
  }

  std::string missing(const std::string& buffer, const std::string& image, const std::string& field) {
    file["buffers"][0]["uri"] = buffer;
    file["images"][0]["uri"] = image;
    file["materials"][1]["extensions"]["WEFT_materials_btf"]["uri"] = field;
    test::writeText(folder / "scene.gltf", file.dump());
    const auto scene = loadGltf(folder / "scene.gltf");
    if (!scene) return scene.error().message();
    std::string warnings;
    for (const std::string& warning : scene->warnings)
      if (!isOfCoordinates(warning)) warnings += warning + "\n";
    if (!warnings.empty() || drawnIn(*scene).size() != 2) return warnings + "something is not shown";
    const auto* textured = dynamic_cast<const PBRMaterial*>(drawnIn(*scene)[0].material.get());
    const bool isTextured = textured && textured->options().baseColorTexture.image;
    const bool isField = dynamic_cast<const BTFMaterial*>(drawnIn(*scene)[1].material.get());
    return isTextured && isField ? "" : "something is not shown";
  }

  std::filesystem::path folder;
  Json file;
  std::string bufferUri;
};

// "Münze" as one character a letter, and with the dots as a character of their own.
constexpr const char* kComposed = "M\u00fcnze";
constexpr const char* kDecomposed = "Mu\u0308nze";

TEST_F(GltfReference, IsAPathFromTheFolderOfTheFile) {
  EXPECT_THAT(missing(folder / "a", "a"), IsEmpty());
  EXPECT_THAT(missing(folder / "my tex+ture", "my%20tex+ture"), IsEmpty());
  EXPECT_THAT(missing(folder / "my tex+ture", "my tex+ture"), IsEmpty());
  EXPECT_THAT(missing(folder / "100%", "100%25"), IsEmpty());
  EXPECT_THAT(missing(folder / "100%", "100%"), IsEmpty()) << "a sign that stands for nothing";
  EXPECT_THAT(missing(folder / "tex" / "a", "./tex/../tex/a"), IsEmpty());
}

TEST_F(GltfReference, MayLeaveItsFolderAndMayBeAbsolute) {
  EXPECT_THAT(missing(folder / ".." / "beside" / "a", "../beside/a"), IsEmpty());
  const auto elsewhere = std::filesystem::absolute(folder.parent_path() / "else where" / "a");
  EXPECT_THAT(missing(elsewhere, elsewhere.string()), IsEmpty());
  const std::string escaped = (elsewhere.parent_path().parent_path() / "else%20where" / "a").string();
  EXPECT_THAT(missing(elsewhere, "file://" + escaped), IsEmpty());
}

TEST_F(GltfReference, MayHaveTheBackslashesOfWindows) {
  EXPECT_THAT(missing(folder / "tex" / "a", "tex%5Ca"), IsEmpty());
  EXPECT_THAT(missing(folder / "tex" / "b", "tex\\b"), IsEmpty());
  EXPECT_THAT(missing(folder / "odd\\name", "odd%5Cname"), IsEmpty()) << "a file may be named so";
}

TEST_F(GltfReference, IsFoundInEveryNormalFormOfUnicode) {
  EXPECT_THAT(missing(folder / kComposed / kDecomposed, std::string(kDecomposed) + "/" + kComposed),
              IsEmpty());
  EXPECT_THAT(missing(folder / "other" / kDecomposed / "a", "other/M%C3%BCnze/a"), IsEmpty());
}

TEST_F(GltfReference, IsNoAddressInANetwork) {
  const std::string message = missing("https://example.org/a.bin", "none", "none");
  EXPECT_THAT(message, AllOf(HasSubstr("https://example.org/a.bin"), HasSubstr("no file")));
}

TEST_F(GltfReference, IsNoPipeWhichWouldBeWaitedFor) {
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(missing("pipe", "pipe", "pipe"), HasSubstr("pipe"));
  EXPECT_THAT(missing(bufferUri, "pipe", "pipe"), HasSubstr("reflectance field"));
}

// ---- Embedded data
// ----------------------------------------------------------------------------------------

class GltfDataUri : public GltfReference {
 protected:
  /// The warnings or failure with these uris for buffer and image.
  std::string said(const std::string& buffer, const std::string& image) {
    if (file["meshes"][0]["primitives"].size() > 1) file["meshes"][0]["primitives"].erase(1);
    file["buffers"][0]["uri"] = buffer;
    file["images"][0]["uri"] = image;
    const auto scene = loadGltf(test::writtenGltf(file.dump()));
    if (!scene) return scene.error().message();
    for (const std::string& warning : scene->warnings)
      if (!isOfCoordinates(warning)) return warning;
    return "";
  }

  std::string bufferBase64() const { return bufferUri.substr(bufferUri.find(',') + 1); }
  std::string imageBase64() const {
    test::BufferBytes bytes;
    bytes.add(valueOf(encodePng(Image(2, 2, 3))));
    return bytes.dataUri().substr(bytes.dataUri().find(',') + 1);
  }
};

TEST_F(GltfDataUri, MayHaveAnyTypeParametersAndNotation) {
  for (const char* header :
       {"data:image/png;base64,", "data:image/jpg;base64,", "data:image/jpeg;base64,", "data:;base64,",
        "data:application/octet-stream;base64,", "data:application/gltf-buffer;base64,",
        "data:text/plain;charset=US-ASCII;base64,", "data:image/png;charset=utf-8;name=a.png;base64,",
        "DATA:Image/PNG;BASE64,", "data:what/ever;base64,"})
    EXPECT_THAT(said(header + bufferBase64(), header + imageBase64()), IsEmpty()) << header;
}

TEST_F(GltfDataUri, MayBeWrappedEscapedOrNoBase64) {
  std::string wrapped = bufferBase64();
  wrapped.insert(8, "\r\n  ");
  std::string escaped = imageBase64();
  for (std::size_t at; (at = escaped.find('+')) != std::string::npos;) escaped.replace(at, 1, "%2B");
  EXPECT_THAT(said("data:;base64," + wrapped, "data:;base64," + escaped), IsEmpty());

  std::string percent = "data:,";
  for (const std::uint8_t byte : valueOf(encodePng(Image(2, 2, 3)))) {
    constexpr const char* digits = "0123456789abcdef";
    percent += {'%', digits[byte >> 4], digits[byte & 15]};
  }
  EXPECT_THAT(said(bufferUri, percent), IsEmpty());
}

TEST_F(GltfDataUri, IsShortenedInEveryMessage) {
  const std::string noise(10'000, 'A');
  const auto isShort =
      AllOf(HasSubstr("data:image/jpg;base64..."), HasSubstr("scene.gltf"),
            testing::ResultOf([](const std::string& text) { return text.size(); }, testing::Lt(500u)));
  EXPECT_THAT(said(bufferUri, "data:image/jpg;base64," + noise), isShort);
  EXPECT_THAT(said("data:image/jpg;base64,$" + noise, ""), isShort) << "no base64";
  EXPECT_THAT(said("data:image/jpg;base64" + noise, ""), HasSubstr("no comma"));
  EXPECT_LT(said("data:image/jpg;base64" + noise, "").size(), 500u);
  EXPECT_LT(said(noise, "").size(), 500u) << "a name that is too long for a file";
  file["materials"][0]["extensions"]["WEFT_materials_btf"]["uri"] = "data:image/x-exr;base64," + noise;
  EXPECT_LT(said(bufferUri, "").size(), 500u);
}

TEST_F(GltfDataUri, ThatIsTooShortForItsBufferIsRefused) {
  EXPECT_THAT(said("data:;base64,AAAA", ""), HasSubstr("/buffers/0 has 36 bytes, of which 3 are there"));
  EXPECT_THAT(said("data:,", ""), HasSubstr("/buffers/0"));
  EXPECT_THAT(said("data:;base64,A", ""), HasSubstr("/buffers/0"));
}

TEST_F(GltfReference, ABuffersFileMayBeLongerAndIsReadOnce) {
  const std::vector<float> numbers{0, 0, 0, 1, 0, 0, 0, 1, 0, 7, 7, 7};
  std::ofstream(folder / "long.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(numbers.data()), 48);
  file["meshes"][0]["primitives"].erase(1);
  file["materials"] = Json::parse(R"([{}])");
  file["buffers"][0]["uri"] = "long.bin";
  test::writeText(folder / "scene.gltf", file.dump());
  EXPECT_THAT(valueOf(loadGltf(folder / "scene.gltf")).warnings, IsEmpty());
  file["bufferViews"][0]["byteLength"] = 48;
  test::writeText(folder / "scene.gltf", file.dump());
  const auto beyond = loadGltf(folder / "scene.gltf");
  ASSERT_FALSE(beyond);
  EXPECT_THAT(beyond.error().message(), HasSubstr("reaches beyond its buffer"));
}

}  // namespace
}  // namespace weft
