// What a viewer shows and how it changes, without window or GL.
#include "ViewerState.h"

#include <gmock/gmock.h>

#include <fstream>
#include <glm/geometric.hpp>
#include <thread>

#include "ClothZip.h"
#include "ConstantField.h"
#include "FileWatch.h"
#include "LightDome.h"
#include "PatchMap.h"
#include "RecentFiles.h"
#include "ResolutionControl.h"
#include "SceneLoader.h"
#include "TestSupport.h"
#include "weft/io/CoordinateMapFile.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;

/// The next thing that is loaded; a failure where none comes.
Result<LoadedView> next(SceneLoader& loader) {
  for (int i = 0; i < 3000; ++i) {
    if (auto loaded = loader.take()) return std::move(*loaded);
    std::this_thread::sleep_for(milliseconds(10));
  }
  return fail("nothing comes");
}

ViewRequest requestFor(const fs::path& file) {
  ViewRequest request;
  request.file = file;
  return request;
}

/// A state that shows a file.
ViewerState shown(const ViewRequest& request) {
  ViewerState state(request, 0.0f, {});
  SceneLoader loader([] {});
  loader.start(*state.takeRequest());
  state.show(next(loader));
  return state;
}

TEST(OrbitCamera, TurnsAroundWhatItLooksAt) {
  OrbitCamera orbit;
  const Bounds scene{glm::dvec3(-1), glm::dvec3(1)};
  orbit.lookAs(Camera::lookAt({0, 0, 5}, {0, 0, 0}), scene);
  const glm::dvec3 before = orbit.camera(scene).position();
  EXPECT_LT(glm::distance(before, glm::dvec3(0, 0, 5)), 1e-9);
  orbit.orbit({-0.25, 0.0});  // to the left: from further right
  EXPECT_GT(orbit.camera(scene).position().x, 1.0);
  EXPECT_NEAR(glm::length(orbit.camera(scene).position()), 5.0, 1e-9);
  orbit.zoom(2);
  EXPECT_NEAR(glm::length(orbit.camera(scene).position()), 4.05, 1e-9);
  orbit.zoom(-1e6);
  EXPECT_LT(glm::length(orbit.camera(scene).position()), 1e4) << "not out of sight";
  orbit.orbit({0.0, 100.0});
  EXPECT_GT(orbit.camera(scene).view[1][1], 0.0) << "never upside down";
}

TEST(OrbitCamera, WhatIsPannedFollowsTheMouse) {
  OrbitCamera orbit;
  const Bounds scene{glm::dvec3(-1), glm::dvec3(1)};
  Camera camera = Camera::lookAt({0, 0, 5}, {0, 0, 0});
  orbit.lookAs(camera, scene);
  orbit.pan({0.5, 0.0});  // by half a picture to the right
  camera = orbit.camera(scene);
  const glm::dvec4 clip = camera.projection(1.0f) * camera.view * glm::dvec4(0, 0, 0, 1);
  EXPECT_NEAR(clip.x / clip.w, 1.0, 1e-6);
  EXPECT_NEAR(clip.y / clip.w, 0.0, 1e-6);
}

TEST(LightDome, DragsMoveTheLampAsTheyAreSeen) {
  const Camera camera = Camera::lookAt({4, 0, 0}, {0, 0, 0});  // -Z is to the right
  const LightDome dome({0, 0, 0}, 10.0);
  glm::dvec3 lamp = dome.dragged({8, 0, 0}, camera, {0.2, 0.0});
  EXPECT_NEAR(glm::length(lamp), 10.0, 1e-9);
  EXPECT_LT(lamp.z, -4.0);
  EXPECT_NEAR(lamp.y, 0.0, 1e-9);
  lamp = dome.dragged(lamp, camera, {-0.2, -0.1});
  EXPECT_NEAR(lamp.z, 0.0, 1e-9);
  EXPECT_GT(lamp.y, 2.0);
  for (int i = 0; i < 50; ++i) lamp = dome.dragged(lamp, camera, {0.3, 0.1});
  EXPECT_TRUE(glm::dot(lamp, lamp) > 99.0) << "stays on the dome behind the scene, too";
}

TEST(ResolutionControl, IsCoarseWhileSomethingMoves) {
  ResolutionControl control;
  const ResolutionControl::Time start{std::chrono::seconds(100)};
  control.drawn(106.0, 1);
  EXPECT_EQ(control.divisor(start), 1) << "at rest";
  control.moved(start);
  EXPECT_EQ(control.divisor(start + milliseconds(10)), 2);
  control.drawn(26.0, 2);
  EXPECT_EQ(control.divisor(start + milliseconds(20)), 2) << "does not change its mind";
  EXPECT_EQ(control.divisor(start + milliseconds(500)), 1) << "within half a second";
  control.drawn(30.0, 1);
  control.moved(start);
  EXPECT_EQ(control.divisor(start), 1) << "quick enough";
  control.drawn(10000.0, 1);
  EXPECT_EQ(control.divisor(start), 4) << "no coarser";
}

TEST(FileWatch, TellsAChangeOnceItIsComplete) {
  const fs::path file = test::testFolder() / "file";
  std::ofstream(file) << "one";
  FileWatch watch;
  watch.watch({file, "/nowhere"});
  EXPECT_FALSE(watch.changed());
  std::ofstream(file) << "longer";
  EXPECT_FALSE(watch.changed()) << "may still be written";
  EXPECT_TRUE(watch.changed());
  EXPECT_FALSE(watch.changed());
  fs::remove(file);
  EXPECT_FALSE(watch.changed() || watch.changed()) << "is away for a moment";
}

TEST(RecentFiles, KeepTheLatestFirst) {
  const fs::path list = test::testFolder() / "state" / "weft" / "recent";
  fs::remove_all(list.parent_path());
  RecentFiles files(list);
  for (const char* name : {"/a", "/b", "/a", "/c"}) test::requireDone(files.add(name));
  EXPECT_THAT(RecentFiles(list).files(), ElementsAre("/c", "/a", "/b"));
  for (int i = 0; i < 100; ++i) test::requireDone(files.add("/" + std::to_string(i)));
  EXPECT_LE(RecentFiles(list).files().size(), 20u);
}

TEST(ViewerState, AFieldAloneIsShownWithItsLamp) {
  const fs::path file = test::testFolder() / "white.rf.exr";
  test::writeConstantField(file, glm::vec3(1));
  ViewRequest request = requestFor(file);
  request.shape = "cloth";
  ViewerState state = shown(request);
  ASSERT_TRUE(state.view()) << state.messages().back();
  EXPECT_EQ(state.view()->shape, "cloth");
  EXPECT_EQ(state.view()->fields.at(0).material->options().textureScale, glm::vec2(768));
  ASSERT_EQ(state.view()->setup.lamps().size(), 1u);
  const glm::dvec3 before = state.view()->setup.lamps()[0].place;
  const auto revision = state.revision();
  state.drag(ViewerState::Drag::Light, {0.1, 0.0});
  EXPECT_GT(glm::distance(state.view()->setup.lamps()[0].place, before), 0.1);
  EXPECT_NE(state.revision(), revision);
  state.addLamp();
  EXPECT_EQ(state.view()->setup.lamps().size(), 2u);
  state.removeLamp();
  state.removeLamp();
  EXPECT_TRUE(state.view()->setup.lamps().empty());
}

TEST(ViewerState, AMaterialIsShownThroughItsMap) {
  const fs::path file = test::testFolder() / "white.rf.exr", map = test::testFolder() / "white.coords.exr";
  test::writeConstantField(file, glm::vec3(1));
  const ViewerState unmapped = shown(requestFor(file));
  const ReflectanceField& field = *unmapped.view()->fields.at(0).field;
  test::requireDone(writeCoordinateMap(map, test::patchMap({6, 4}, {field.width(), field.height()}, 2)));
  ViewRequest request = requestFor("shape:sphere");
  request.scene.materialFiles["*"] = file.string();
  for (const bool alone : {false, true}) {
    if (alone) request = requestFor(file);
    request.scene.mapFiles["*"] = map.string();
    ViewerState state = shown(request);
    ASSERT_TRUE(state.view()) << state.messages().back();
    EXPECT_EQ(state.view()->fields.at(0).material->surfaceSize(), glm::ivec2(6, 4));
    state.open("shape:cloth");
    EXPECT_TRUE(state.takeRequest()->scene.mapFiles.empty());
  }
}

TEST(ViewerState, WhatPeopleChangedStaysWhenAFileIsReadAgain) {
  const fs::path file = test::testFolder() / "white.rf.exr";
  test::writeConstantField(file, glm::vec3(1));
  ViewerState state = shown(requestFor(file));
  state.drag(ViewerState::Drag::Light, {0.1, 0.0});
  state.drag(ViewerState::Drag::Orbit, {0.1, 0.0});
  BTFMaterialOptions options = state.view()->fields.at(0).material->options();
  options.textureScale *= 3.0f;
  options.tint = {1, 0, 0};
  state.setOptions(0, options);
  const glm::dvec3 lamp = state.view()->setup.lamps()[0].place, eye = state.camera().position();
  test::writeConstantField(file, glm::vec3(0.5f));
  state.reload();
  SceneLoader loader([] {});
  loader.start(*state.takeRequest());
  state.show(next(loader));
  EXPECT_EQ(state.view()->setup.lamps()[0].place, lamp);
  EXPECT_EQ(state.camera().position(), eye);
  EXPECT_EQ(state.view()->fields.at(0).material->options().textureScale, options.textureScale);
  EXPECT_EQ(state.view()->fields.at(0).material->options().tint, options.tint);
}

TEST(ViewerState, ABrokenFileLeavesAMessageAndAllAsItIs) {
  ViewerState state = shown(requestFor("shape:sphere"));
  const fs::path file = test::testFolder() / "broken.rf.exr";
  std::ofstream(file) << "no field";
  state.open(file);
  SceneLoader loader([] {});
  loader.start(*state.takeRequest());
  state.show(next(loader));
  EXPECT_EQ(state.request().file, "shape:sphere");
  ASSERT_EQ(state.messages().size(), 1u);
  EXPECT_THAT(state.messages()[0], HasSubstr("broken.rf.exr"));
}

TEST(ViewerState, APictureOfAnEnvironmentLightsWhatIsShown) {
  ViewerState state = shown(requestFor("shape:sphere"));
  EXPECT_EQ(state.toneCurve(), ToneCurve::None);
  const fs::path file = test::testFolder() / "room.hdr";
  std::ofstream(file) << "#?RADIANCE\n";
  state.open(file);
  const auto request = state.takeRequest();
  ASSERT_TRUE(request);
  EXPECT_EQ(request->file, "shape:sphere");
  EXPECT_EQ(request->scene.environment, file);
  EXPECT_FALSE(state.takeRequest()) << "once";
}

TEST(SceneLoader, FitsAMeasurement) {
  const fs::path zip = test::clothZip(test::testFolder());
  ViewRequest request = requestFor(zip);
  request.model = "rfp";
  SceneLoader loader([] {});
  loader.start(request);
  const Result<LoadedView> view = next(loader);
  ASSERT_TRUE(view) << view.error().message();
  EXPECT_EQ(view->model, "rfp");
  EXPECT_FALSE(view->isPart);
  EXPECT_THAT(view->fields.at(0).error, HasSubstr("eps 0.0"));
}

// What was under way is given up, and its result never comes.
TEST(SceneLoader, ShowsTheLatest) {
  const fs::path zip = test::clothZip(test::testFolder());
  SceneLoader loader([] {});
  loader.start(requestFor(zip));
  loader.start(requestFor("shape:plane"));
  const Result<LoadedView> view = next(loader);
  ASSERT_TRUE(view) << view.error().message();
  EXPECT_EQ(view->request.file, "shape:plane");
}

}  // namespace
}  // namespace weft
