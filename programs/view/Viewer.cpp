#include "Viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "weft/io/ImageFile.h"
#include "weft/scenegraph/RenderAction.h"
#include "weft/scenegraph/RenderTarget.h"

namespace weft {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks(400);
constexpr double kTurnsASecond = 0.1;
constexpr int kSettling = 3;
constexpr int kSupersampling = 2;
constexpr int kMostScreenshots = 1000;

double millisecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// The first of weft-view-001.png and on that is not there.
std::filesystem::path freeScreenshotName() {
  for (int i = 1; i < kMostScreenshots; ++i)
    if (const std::string name = fmt::format("weft-view-{:03}.png", i); !std::filesystem::exists(name))
      return name;
  return "weft-view.png";
}

}  // namespace

Viewer::Viewer(ViewerWindow& window, ViewerState& state) : window_(window), state_(state) {
  listen();
  const glm::vec2 size(window_.framebufferSize());
  if (size.y > 0.0f) state_.setAspect(size.x / size.y);  // before anything is framed
}

Result<std::unique_ptr<Viewer>> Viewer::create(ViewerWindow& window, ViewerState& state) {
  std::unique_ptr<Viewer> viewer(new Viewer(window, state));
  WEFT_TRY(viewer->weft_, PassiveWindow::adopt());
  WEFT_TRY(viewer->picture_, ScenePicture::create());
  return viewer;
}

void Viewer::listen() {
  ViewerWindow::Listener listener;
  listener.keyPressed = [this](int key, int modifiers) { pressKey(key, modifiers); };
  listener.buttonPressed = [this](int button, int modifiers) { pressButton(button, modifiers); };
  listener.buttonReleased = [this] { drag_ = ViewerState::Drag::None; };
  listener.cursorMoved = [this](glm::dvec2 movement) { drag(movement); };
  listener.scrolled = [this](double steps) {
    state_.zoom(steps);
    resolution_.moved(Clock::now());
  };
  listener.dropped = [this](const std::vector<std::filesystem::path>& files) {
    for (const std::filesystem::path& file : files) state_.open(file);
  };
  listener.exposed = [this] { framesToDraw_ = kSettling; };
  window_.setListener(std::move(listener));
}

void Viewer::pressKey(int key, int modifiers) {
  switch (key) {
    case GLFW_KEY_F:
      state_.frame();
      break;
    case GLFW_KEY_H:
    case GLFW_KEY_F1:
      panel_.toggleHelp();
      break;
    case GLFW_KEY_TAB:
      panel_.toggle();
      break;
    case GLFW_KEY_S:
      takeScreenshot();
      break;
    case GLFW_KEY_R:
      state_.reload();
      break;
    case GLFW_KEY_1:
      state_.setShape("cloth");
      break;
    case GLFW_KEY_2:
      state_.setShape("sphere");
      break;
    case GLFW_KEY_3:
      state_.setShape("plane");
      break;
    case GLFW_KEY_T:
      turns_ = !turns_;
      latestTurn_ = Clock::now();
      break;
    case GLFW_KEY_Q:
      if (modifiers & GLFW_MOD_CONTROL) window_.close();
      break;
    default:
      break;
  }
}

void Viewer::pressButton(int button, int modifiers) {
  using Drag = ViewerState::Drag;
  state_.clearMessages();  // they were seen
  if (button == GLFW_MOUSE_BUTTON_RIGHT || window_.isKeyDown(GLFW_KEY_L))
    drag_ = Drag::Light;
  else if (button == GLFW_MOUSE_BUTTON_MIDDLE || (modifiers & GLFW_MOD_SHIFT))
    drag_ = Drag::Pan;
  else
    drag_ = Drag::Orbit;
}

void Viewer::drag(glm::dvec2 movement) {
  if (drag_ == ViewerState::Drag::None) return;
  state_.drag(drag_, movement);
  resolution_.moved(Clock::now());
}

void Viewer::run() {
  while (!window_.shouldClose()) step();
}

void Viewer::step() {
  window_.wait(patience());
  framesToDraw_ = std::max(framesToDraw_, 1);  // whatever happened
  if (auto request = state_.takeRequest()) loader_.start(std::move(*request));
  takeLoaded();
  watchFiles();
  turnTable();
  drawFrame();
}

Result<Viewer::Timing> Viewer::timeDrag(int frames, Clock::time_point start) {
  while (!state_.view()) {
    step();
    if (!state_.view() && !state_.messages().empty()) return fail(state_.messages().back());
  }
  Timing timing{.firstFrame = millisecondsSince(start)};
  for (int i = 0; i < frames; ++i) {
    const Clock::time_point startOfFrame = Clock::now();
    const double angle = glm::two_pi<double>() * i / 60.0;
    state_.drag(ViewerState::Drag::Light, 0.02 * glm::dvec2(std::cos(angle), std::sin(angle)));
    resolution_.moved(startOfFrame);
    drawFrame();
    timing.frames.push_back(millisecondsSince(startOfFrame));
  }
  const Clock::time_point end = Clock::now();
  while (drawnDivisor_ > 1) step();
  timing.fullPicture = millisecondsSince(end);
  return timing;
}

void Viewer::takeLoaded() {
  while (auto loaded = loader_.take()) {
    const bool isThere = loaded->has_value();
    state_.show(std::move(*loaded));
    framesToDraw_ = kSettling;
    if (!isThere) continue;
    resolution_.forget();
    const LoadedView& view = *state_.view();
    watch_.watch(view.files);
    window_.setTitle(fmt::format("{} - weft-view", view.request.file.filename().string()));
    if (std::filesystem::exists(view.request.file))
      if (const auto kept = recent_.add(view.request.file); !kept) state_.tell(kept.error().message());
  }
}

void Viewer::watchFiles() {
  if (Clock::now() < nextLook_) return;
  nextLook_ = Clock::now() + kBetweenLooks;
  if (watch_.changed()) state_.reload();
}

void Viewer::turnTable() {
  if (!turns_) return;
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - std::exchange(latestTurn_, now)).count();
  state_.turnScene(glm::two_pi<double>() * kTurnsASecond * seconds);
  resolution_.moved(now);
}

bool Viewer::needsScene() const {
  return state_.view() && (drawnRevision_ != state_.revision() || drawnSize_ != window_.framebufferSize() ||
                           drawnDivisor_ > resolution_.divisor(Clock::now()));
}

/// Seconds that nothing need be drawn for.
double Viewer::patience() const {
  if (framesToDraw_ > 0 || turns_ || needsScene()) return 0.0;
  if (drawnDivisor_ == 1) return std::chrono::duration<double>(kBetweenLooks).count();
  return std::max(0.001, std::chrono::duration<double>(resolution_.rest() - Clock::now()).count());
}

void Viewer::drawScene() {
  drawnRevision_ = state_.revision();
  drawnSize_ = window_.framebufferSize();
  drawnDivisor_ = resolution_.divisor(Clock::now());
  const Clock::time_point start = Clock::now();
  const auto drawn =
      picture_->draw(*weft_, state_.view()->setup.root(), state_.camera(), drawnSize_, drawnDivisor_);
  milliseconds_ = millisecondsSince(start);
  resolution_.drawn(milliseconds_, drawnDivisor_);
  if (!drawn) state_.tell(drawn.error().message());
  if (!drawn) drawnRevision_ = state_.revision();  // it would fail again
}

void Viewer::drawFrame() {
  const glm::ivec2 size = window_.framebufferSize();
  if (size.x == 0 || size.y == 0) return;
  if (size != drawnSize_) state_.setAspect(static_cast<float>(size.x) / static_cast<float>(size.y));
  if (needsScene()) drawScene();
  if (framesToDraw_ > 0) --framesToDraw_;
  window_.begin();
  picture_->show(size, state_.exposure(), state_.toneCurve());
  panel_.draw(state_, recent_, {loader_.doing(), milliseconds_, drawnDivisor_});
  window_.finish();
}

// As weft-render draws it, without the panel.
void Viewer::takeScreenshot() {
  if (!state_.view()) return;
  const auto take = [&]() -> Result<std::string> {
    const glm::ivec2 size = kSupersampling * window_.framebufferSize();
    const RenderTarget target(size.x, size.y, Precision::Float);
    WEFT_TRY_VOID(target.prepare(weft_->context()));
    WEFT_TRY_VOID(RenderAction().render(weft_->context(), state_.view()->setup.root(), state_.camera(),
                                        target, {.background = ScenePicture::background()}));
    FloatImage picture = target.read(weft_->context(), kSupersampling);
    expose(picture, state_.exposure(), state_.toneCurve());
    const std::filesystem::path file = freeScreenshotName();
    WEFT_TRY_VOID(writePng(file, picture));
    return std::filesystem::absolute(file).string();
  };
  const Result<std::string> taken = take();
  state_.tell(taken ? "screenshot: " + *taken : taken.error().message());
}

}  // namespace weft
